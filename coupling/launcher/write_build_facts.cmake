# cmake -DHEADER=... -DSOURCE=... -DVERSION=... -DFLAGS=... -DLIBRARIES="name version|..." -P write_build_facts.cmake
# Writes HEADER only when its content changes, so that an unchanged commit compiles nothing.
execute_process(COMMAND git describe --always --dirty --abbrev=12 WORKING_DIRECTORY ${SOURCE}
                OUTPUT_VARIABLE git OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE failed)
if(failed OR NOT git)
  set(git unknown)
endif()
set(json "")
string(REPLACE "|" ";" libraries "${LIBRARIES}")
foreach(library IN LISTS libraries)
  string(REGEX REPLACE "^([^ ]+) ?(.*)$" "\\\\\"\\1\\\\\": \\\\\"\\2\\\\\"" entry "${library}")
  list(APPEND json "${entry}")
endforeach()
list(JOIN json ", " json)
set(text "#pragma once
// Written by write_build_facts.cmake.
#define STANDOFF_FACT_VERSION \"${VERSION}\"
#define STANDOFF_FACT_GIT \"${git}\"
#define STANDOFF_FACT_FLAGS \"${FLAGS}\"
#define STANDOFF_FACT_LIBRARIES \"{${json}}\"
#define STANDOFF_FACT_SOURCE \"${SOURCE}\"
")
set(old "")
if(EXISTS ${HEADER})
  file(READ ${HEADER} old)
endif()
if(NOT old STREQUAL text)
  file(WRITE ${HEADER} "${text}")
endif()
