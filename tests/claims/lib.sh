# SPDX-FileCopyrightText: 2026 The PaGO authors
# SPDX-License-Identifier: BSD-3-Clause
#
# shellcheck shell=bash disable=SC2034
#
# What the claims share; each script sources it. Needs bash, awk and the core utilities only: robots have no more.
set -uo pipefail
export LC_ALL=C # decimal points
claims=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$(cd "$claims/../.." && pwd)
export PAGO=${PAGO:-$root/build/release/pago} PAGO_DATA=${PAGO_DATA:-$root/build/data}
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
time_limit_s=900 # for one run of the program

# --- results

result() { printf '%-70s | %24s | %-26s | %s\n' "$@"; }

is_number() { [[ $1 =~ ^[-+]?[0-9]+\.?[0-9]*([eE][-+]?[0-9]+)?$ ]]; }

# compare CLAIM FIGURE "AWK CONDITION ON x" BOUND [UNIT]
compare() {
  local verdict=FAIL
  if ! is_number "$2"; then
    result "$1" "not measured" "$4" FAIL
    return
  fi
  if awk -v x="$2" "BEGIN { exit !($3) }"; then verdict=ok; fi
  result "$1" "$(awk -v x="$2" 'BEGIN { printf x == int(x) ? "%d" : "%.4f", x }')${5:+ $5}" "$4" "$verdict"
}
at_most() { compare "$1" "$2" "x <= $3" "<= $3${4:+ $4}" "${4:-}"; }
below() { compare "$1" "$2" "x < $3" "< $3${4:+ $4}" "${4:-}"; }
at_least() { compare "$1" "$2" "x >= $3" ">= $3${4:+ $4}" "${4:-}"; }
# within CLAIM FIGURE CENTRE MARGIN [UNIT]
within() { compare "$1" "$2" "x >= $3 - ($4) && x <= $3 + $4" "$3 +- $4${5:+ $5}" "${5:-}"; }
# exactly CLAIM FIGURE BOUND: as text. An empty figure is never right.
exactly() {
  local verdict=FAIL
  if [[ -n $2 && $2 == "$3" ]]; then verdict=ok; fi
  result "$1" "${2:-not measured}" "$3" "$verdict"
}

# --- runs

# pago_in NAME COMMAND...: executes it; output in $scratch/NAME.out and .err, exit code in $status.
pago_in() {
  timeout --kill-after=10 "$time_limit_s" "${@:2}" >"$scratch/$1.out" 2>"$scratch/$1.err" </dev/null
  status=$?
}
# pago_run NAME SOURCE [OPTION...]: its files are in $(results NAME).
pago_run() { pago_in "$1" "$PAGO" run "${@:2}" --output "$scratch/$1"; }
results() { echo "$scratch/$1/latest"; }
pose_files=(odometry.kitti odometry.tum trajectory.kitti trajectory.tum)

# evaluate TRUTH ESTIMATE [OPTION...]: leaves its figures in $scratch/evaluation.json.
evaluate() {
  "$PAGO" evaluate "$@" --json >"$scratch/evaluation.json" 2>"$scratch/evaluation.err" && return
  cat "$scratch/evaluation.err" >&2
  : >"$scratch/evaluation.json"
}

# --- figures

# All of them print nothing for a file that is not there.
read_lines() { if [[ -f $1 ]]; then cat "$1"; fi; }
count_lines() { if [[ -f $1 ]]; then wc -l <"$1"; fi; }
# leaves FILE: every value of a JSON file, see json.awk.
leaves() { if [[ -s $1 ]]; then awk -f "$claims/json.awk" "$1"; fi; }
# json FILE PATH: one value, by the names and indices that lead to it (packets.bad.size, absolute.0.rmse_m).
json() { leaves "$1" | awk -F '\t' -v path="$2" '$1 == path { print $2 }'; }
of_run() { json "$(results "$1")/run.json" "$2"; }
of_evaluation() { json "$scratch/evaluation.json" "$1"; }
# The absolute error under SE(3) alignment.
ate_se3() {
  leaves "$scratch/evaluation.json" | awk -F '\t' '
    $1 ~ /^absolute\.[0-9]+\.aligned_by$/ { is_se3 = $2 == "SE(3)" }
    $1 ~ /^absolute\.[0-9]+\.rmse_m$/ && is_se3 { print $2 }'
}
# motion FILE FIGURE: of a trajectory in KITTI rows, see motion.awk. Not PaGO's own arithmetic.
motion() {
  if [[ -s $1 ]]; then awk -f "$claims/motion.awk" "$1" | awk -v figure="$2" '$1 == figure { print $2 }'; fi
}
