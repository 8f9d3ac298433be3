# Puts the files of template/ into a C file, for template.h:
#
#   cmake -D FOLDER=template -D "SCRIPTS=a.js;b.js" -D OUTPUT=page_template.c -P embed.cmake
#
# The scripts become one, in this order. Their hash, and the style sheet's, are what the page's content security policy
# allows: nothing else on it runs.
cmake_minimum_required(VERSION 3.20)

# The 64 hexadecimal digits of a SHA-256 in base 64: three digits are twelve bits, two letters; the last digit is one.
function(base64 hex result)
  set(letters ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/)
  set(text "")
  foreach(at RANGE 0 60 3)
    string(SUBSTRING ${hex} ${at} 3 digits)
    math(EXPR high "0x${digits} >> 6")
    math(EXPR low "0x${digits} & 63")
    string(SUBSTRING ${letters} ${high} 1 first)
    string(SUBSTRING ${letters} ${low} 1 second)
    string(APPEND text ${first}${second})
  endforeach()
  string(SUBSTRING ${hex} 63 1 digit)
  math(EXPR last "0x${digit} << 2")
  string(SUBSTRING ${letters} ${last} 1 letter)
  set(${result} "${text}${letter}=" PARENT_SCOPE)
endfunction()

# const char NAME[] with the bytes of a file, and with what would end an element of the page made an error.
function(embed file name)
  file(READ "${file}" bytes HEX)
  string(REGEX REPLACE "(................................)" "\\1\n" bytes "${bytes}")
  string(REGEX REPLACE "([0-9a-f][0-9a-f])" "0x\\1," bytes "${bytes}")
  file(APPEND "${OUTPUT}.part" "const char ${name}[] = {\n${bytes}0};\n")
endfunction()

function(embed_hash file name)
  file(SHA256 "${file}" hex)
  base64(${hex} hash)
  file(APPEND "${OUTPUT}.part" "const char ${name}[] = \"sha256-${hash}\";\n")
endfunction()

set(script "${OUTPUT}.js")
file(WRITE "${script}" "\"use strict\";\n(() => {\n")
foreach(each IN LISTS SCRIPTS)
  file(READ "${FOLDER}/${each}" text)
  string(FIND "${text}" "</script" end)
  if(NOT end EQUAL -1)
    message(FATAL_ERROR "${each} would end the element that it stands in")
  endif()
  file(APPEND "${script}" "${text}")
endforeach()
file(APPEND "${script}" "})();\n")

file(WRITE "${OUTPUT}.part" "/* Made by embed.cmake from page/template. */\n#include \"page/template.h\"\n\n")
embed("${FOLDER}/page.html" gis_template_page)
embed("${FOLDER}/page.css" gis_template_style)
embed("${script}" gis_template_script)
embed_hash("${FOLDER}/page.css" gis_template_style_hash)
embed_hash("${script}" gis_template_script_hash)
file(RENAME "${OUTPUT}.part" "${OUTPUT}")
