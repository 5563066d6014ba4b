# Writes OUTPUT, a header with a digest of the files SOURCES: drives rendered by other code are other drives.
set(all "")
foreach(source IN LISTS SOURCES)
  file(SHA256 ${source} digest)
  string(APPEND all ${digest})
endforeach()
string(SHA256 digest "${all}")
file(WRITE ${OUTPUT} "#pragma once\nnamespace pago::simulator {\ninline constexpr char kSourcesDigest[] = \"${digest}\\n\";\n}\n")
