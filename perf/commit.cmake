# cmake -DSOURCE=folder -DHEADER=file -P commit.cmake: writes the commit of `folder` as a C++ constant, if it changed.
execute_process(COMMAND git describe --always --dirty --abbrev=8 --exclude=*
  WORKING_DIRECTORY ${SOURCE} OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
if(NOT commit)
  set(commit "unknown commit")
endif()
set(text "inline constexpr char kCommit[] = \"${commit}\";\n")
if(EXISTS ${HEADER})
  file(READ ${HEADER} present)
endif()
if(NOT text STREQUAL present)
  file(WRITE ${HEADER} "${text}")
endif()
