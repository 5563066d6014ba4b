// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "style.hpp"

namespace pago::page {

/// Series colours: those of Okabe and Ito (2008), darkened on white and lightened on black to keep a contrast
/// of at least 3 : 1.
std::string_view style() noexcept {
  return R"css(
:root{color-scheme:light dark;--paper:#fff;--card:#f6f7f9;--ink:#1b1f24;--soft:#5b6470;--rule:#d9dde3;--grid:#e6e9ee;
--good:#0a7d4f;--bad:#b3261e;--warn:#fff4d6;--warnrule:#d9a400;--cn:#1b1f24;
--c0:#0067a5;--c1:#c94f00;--c2:#00835c;--c3:#b4488c;--c4:#8a6d00;--c5:#2b8fc2;--c6:#7a4fb5;--c7:#5f6b2f}
@media (prefers-color-scheme:dark){:root{--paper:#14171b;--card:#1d2127;--ink:#e8eaed;--soft:#9aa4b0;--rule:#363c45;
--grid:#2b3038;--good:#5bd6a2;--bad:#ff8a80;--warn:#3a3013;--warnrule:#d9a400;--cn:#e8eaed;
--c0:#5cb3ee;--c1:#ff9a57;--c2:#3fcf9e;--c3:#ec8fc7;--c4:#e3c34a;--c5:#8fd3f5;--c6:#bda0f0;--c7:#b6c46f}}
*{box-sizing:border-box}
body{margin:0 auto;max-width:76rem;padding:1.2rem 1.2rem 3rem;background:var(--paper);color:var(--ink);
font:1rem/1.5 system-ui,-apple-system,"Segoe UI",Roboto,"Noto Sans","DejaVu Sans",sans-serif}
h1{font-size:1.7rem;line-height:1.2;margin:.4rem 0 .3rem}
h2{font-size:1.25rem;margin:2.2rem 0 .3rem;padding-top:.6rem;border-top:1px solid var(--rule)}
h3{font-size:1rem;margin:0 0 .2rem}
p{margin:.3rem 0 .8rem;max-width:48rem}
.lead{font-size:1.1rem;color:var(--soft)}
footer,figcaption,.tile small{color:var(--soft);font-size:.85rem}
footer{margin-top:3rem;border-top:1px solid var(--rule);padding-top:.6rem;overflow-wrap:anywhere}
.tiles{display:grid;grid-template-columns:repeat(auto-fit,minmax(9.5rem,1fr));gap:.7rem;margin:1rem 0}
.tile{background:var(--card);border-radius:.6rem;padding:.7rem .9rem}
.tile b{display:block;font-size:1.7rem;line-height:1.25;font-weight:650;font-variant-numeric:tabular-nums}
.tile b span{font-size:.9rem;font-weight:400;color:var(--soft);margin-left:.25rem}
.tile small{display:block;line-height:1.35}
.grid{display:grid;grid-template-columns:repeat(auto-fit,minmax(min(100%,27rem),1fr));gap:1.4rem 1.8rem;margin:.8rem 0}
figure{margin:0;min-width:0}
svg{display:block;width:100%;height:auto;touch-action:pan-y}
svg text{font-size:13px;fill:var(--soft)}
svg .label{fill:var(--ink)}
svg .mid{text-anchor:middle}svg .end{text-anchor:end}
svg .rule{stroke:var(--grid);stroke-width:1}
svg .axis{stroke:var(--soft);stroke-width:1}
svg .level{stroke:var(--soft);stroke-width:1;stroke-dasharray:5 4}
svg .hair{stroke:var(--soft);stroke-width:.7}
.line{fill:none;stroke-width:1.7;stroke-linejoin:round;stroke-linecap:round}
.bar{fill-opacity:.45;stroke-width:0}.solid{stroke-width:0}
.line.cn{stroke-width:2.2;stroke-dasharray:1 4}
.legend{list-style:none;display:flex;flex-wrap:wrap;gap:.1rem .9rem;margin:0 0 .1rem;padding:0;font-size:.85rem}
.legend li{cursor:pointer;overflow-wrap:anywhere}.legend li.off{opacity:.4;text-decoration:line-through}
.legend i{display:inline-block;width:.8rem;height:.8rem;border-radius:.2rem;margin-right:.35rem;vertical-align:-.08rem}
g.off{display:none}
output{display:block;min-height:1.3em;font-size:.85rem;font-variant-numeric:tabular-nums;color:var(--soft)}
.notice{background:var(--warn);border-left:.3rem solid var(--warnrule);border-radius:.3rem;padding:.6rem .9rem;margin:.8rem 0}
.notice b{display:block}.notice p{margin:0;max-width:none;overflow-wrap:anywhere}
.scroll{overflow-x:auto;margin:.6rem 0 1rem}
table{border-collapse:collapse;font-size:.92rem;font-variant-numeric:tabular-nums}
th,td{padding:.28rem .8rem;text-align:right;border-bottom:1px solid var(--rule);white-space:nowrap}
th:first-child,td:first-child{text-align:left;padding-left:0}
thead th{color:var(--soft);font-weight:600;vertical-align:bottom}
thead th:not(:first-child){white-space:normal;max-width:14rem;overflow-wrap:anywhere}
td small{color:var(--soft);margin-left:.4rem}
td .good{color:var(--good)}td .bad{color:var(--bad)}
td.best{font-weight:700}
details{margin:.6rem 0}summary{cursor:pointer;color:var(--soft)}
.c0{--c:var(--c0)}.c1{--c:var(--c1)}.c2{--c:var(--c2)}.c3{--c:var(--c3)}.c4{--c:var(--c4)}.c5{--c:var(--c5)}
.c6{--c:var(--c6)}.c7{--c:var(--c7)}.cn{--c:var(--cn)}
.line{stroke:var(--c)}.dot,.bar,.solid{fill:var(--c)}.legend i{background:var(--c)}
@media (max-width:40rem){body{padding:.7rem .8rem 2rem}h1{font-size:1.35rem}.tile b{font-size:1.35rem}
th,td{padding:.25rem .5rem}.tiles{grid-template-columns:repeat(auto-fit,minmax(7.5rem,1fr))}}
@media print{:root{--paper:#fff;--card:#f3f4f6;--ink:#000;--soft:#444;--rule:#bbb;--grid:#ddd;--cn:#000;--c0:#0067a5;
--c1:#c94f00;--c2:#00835c;--c3:#b4488c;--c4:#8a6d00;--c5:#2b8fc2;--c6:#7a4fb5;--c7:#5f6b2f}
*{print-color-adjust:exact;-webkit-print-color-adjust:exact}body{font-size:10pt;max-width:none;padding:0}
figure,.tile,tr,.notice{break-inside:avoid}h2,h3{break-after:avoid}output{display:none}
.grid{grid-template-columns:1fr 1fr;gap:.8rem}}
)css";
}

/// Values under the pointer, and series that come and go with their legend.
std::string_view script() noexcept {
  return R"js(
document.querySelectorAll('figure').forEach(f=>{
  f.querySelectorAll('.legend li').forEach(li=>li.onclick=()=>{
    const off=li.classList.toggle('off');
    f.querySelectorAll('g[data-series="'+li.dataset.series+'"]').forEach(g=>g.classList.toggle('off',off));
  });
  const svg=f.querySelector('svg[data-x]');
  if(!svg||!svg.querySelector('polyline'))return;
  const scale=t=>{const[a,b,p,q,log]=t.split(' ').map(Number);
    return v=>{const s=(v-p)/(q-p);return log?a*Math.pow(b/a,s):a+s*(b-a);}};
  const x=scale(svg.dataset.x),y=scale(svg.dataset.y),map=svg.dataset.map=='1';
  const show=v=>Number(v.toPrecision(4)).toString();
  const lines=[...svg.querySelectorAll('polyline')].map(p=>({g:p.parentNode,
    at:p.getAttribute('points').trim().split(' ').map(q=>q.split(',').map(Number))}));
  const out=document.createElement('output');svg.after(out);
  const hair=svg.querySelector('line').cloneNode();
  hair.setAttribute('class','hair');hair.setAttribute('x1',-9);hair.setAttribute('x2',-9);svg.append(hair);
  svg.onpointermove=e=>{
    const r=svg.getBoundingClientRect(),k=svg.viewBox.baseVal.width/r.width;
    const px=(e.clientX-r.left)*k,py=(e.clientY-r.top)*k,best=new Map();
    for(const l of lines){
      if(l.g.classList.contains('off'))continue;
      for(const q of l.at){
        const d=map?Math.hypot(q[0]-px,q[1]-py):Math.abs(q[0]-px),b=best.get(l.g);
        if(!b||d<b.d)best.set(l.g,{d:d,q:q});
      }
    }
    let text='',at=px;
    for(const[g,b]of best){
      if(!map&&b.d>12)continue;
      if(map&&b.d>40)continue;
      at=b.q[0];
      text+=(text?' · ':'')+(g.dataset.name?g.dataset.name+' ':'')+(map?show(x(b.q[0]))+', ':'')+show(y(b.q[1]));
    }
    if(text&&!map)text=svg.dataset.label+' '+show(x(at))+': '+text;
    out.textContent=text;
    for(const[n,v]of[['x1',at],['x2',at],['y1',10],['y2',svg.viewBox.baseVal.height-42]])
      hair.setAttribute(n,map||!text?-9:v);
  };
  svg.onpointerleave=()=>{out.textContent='';['x1','x2'].forEach(n=>hair.setAttribute(n,-9));};
});
)js";
}

}  // namespace pago::page
