# Writes the addresses of addresses.cmake into README.md and SECURITY.md, between the comments `addresses` and
# `/addresses`; what stood there before is replaced.
#
#   cmake [-DSUNDER_HOMEPAGE=https://... ...] [-DROOT=FOLDER] -P gis/package/fill_addresses.cmake
#
# ROOT is the folder that holds the two pages, the project's unless given. tests/package/test_addresses.sh asks that the
# pages of the project are what this script makes of them.
include(${CMAKE_CURRENT_LIST_DIR}/addresses.cmake)
if(NOT ROOT)
  get_filename_component(ROOT ${CMAKE_CURRENT_LIST_DIR}/../.. ABSOLUTE)
endif()

function(fill page text)
  set(begin "<!-- addresses -->\n")
  set(end "<!-- /addresses -->\n")
  file(READ ${ROOT}/${page} content)
  string(FIND "${content}" "${begin}" from)
  string(FIND "${content}" "${end}" to)
  if(from EQUAL -1 OR to EQUAL -1)
    message(FATAL_ERROR "${page}: there is no place for addresses")
  endif()
  string(LENGTH "${begin}" length)
  math(EXPR from "${from} + ${length}")
  string(SUBSTRING "${content}" 0 ${from} before)
  string(SUBSTRING "${content}" ${to} -1 after)
  file(WRITE ${ROOT}/${page} "${before}${text}${after}")
endfunction()

set(lines "")
foreach(row "Homepage|${SUNDER_HOMEPAGE}" "Source code|${SUNDER_REPOSITORY}" "Issues|${SUNDER_TRACKER}"
            "Private reports of vulnerabilities|${SUNDER_PRIVATE_REPORTS}" "Maintainer|${SUNDER_EMAIL}")
  string(REGEX MATCH "^([^|]*)[|](.+)$" found "${row}")
  if(found)
    string(APPEND lines "- ${CMAKE_MATCH_1}: <${CMAKE_MATCH_2}>\n")
  endif()
endforeach()
if(lines)
  set(lines "\n${lines}\n")
endif()
fill(README.md "${lines}")

if(SUNDER_PRIVATE_REPORTS)
  fill(SECURITY.md "\nReport it privately: <${SUNDER_PRIVATE_REPORTS}>.\n\n")
else()
  fill(SECURITY.md "\nNo release is published yet, so there is no address for private reports: ask where you got the program.\n\n")
endif()
