# Turns constants into variables (tuning.h describes the purpose):
#
#   cmake -D SOURCE=src -D "ROOMS=outline;separation/squares" -D OUTPUT=folder -P tunable.cmake
#
# For each room it writes folder/<room>/tuning.h, which is included in place of the source's, and
# folder/<room>/tuning_struct.h; folder/constants.c lists all of them. A constant stays one if its value is not a plain
# number (an expression of other constants follows these), or if its line says "fixed", as for an error bound or the
# size of an array.
cmake_minimum_required(VERSION 3.20)

set(integer "[0-9]+u?")
set(real "[0-9]+[.]?[0-9]*(e-?[0-9]+)?f?")
set(binary "0x[0-9]+p-?[0-9]+")
set(number "(${binary}|${real}|${integer}|[(]1 - ${binary}[)]|[(]1u << [0-9]+[)])")

set(structs "")
set(variables "")
set(table "")
set(versions "")
foreach(room IN LISTS ROOMS)
  get_filename_component(name ${room} NAME)
  string(TOUPPER ${name} upper)
  set(header ${SOURCE}/${room}/tuning.h)
  file(READ ${header} text)
  if(NOT text MATCHES "#define SUNDER_I_[A-Z]+_TUNING_VERSION ([0-9]+)")
    message(FATAL_ERROR "${header} has no version")
  endif()
  string(APPEND versions "    {\"${name}\", ${CMAKE_MATCH_1}},\n")
  # Headings and constants, in their order; without characters that are part of the syntax of CMake's lists.
  string(REGEX REPLACE "[][;\\]" " " text "${text}")
  string(REGEX MATCHALL "\n/[*] ---- [^\n]*|\n#define [A-Z_0-9]+ [^\n]+" lines "${text}")
  set(group "")
  set(members "")
  set(values "")
  set(undefine "")
  set(define "")
  foreach(line IN LISTS lines)
    if(line MATCHES "^\n/[*] ---- (.*[^- ]) -+ [*]/")
      set(group "${CMAKE_MATCH_1}")
    elseif(NOT line MATCHES "fixed" AND NOT line MATCHES "_VERSION" AND
           line MATCHES "^\n#define ([A-Z_0-9]+) +${number}( +/[*].*)?$")
      set(constant ${CMAKE_MATCH_1})
      set(value "${CMAKE_MATCH_2}")
      string(APPEND undefine "#undef ${constant}\n")
      string(APPEND define "#define ${constant} (sunder_i_${name}_tuning.${constant})\n")
      string(APPEND members "    __typeof__(${value}) ${constant};\n")
      string(APPEND values "    .${constant} = ${value},\n")
      string(APPEND table "    TUNABLE(${name}, \"${group}\", ${constant}),\n")
    endif()
  endforeach()
  file(WRITE ${OUTPUT}/${room}/tuning_struct.h
       "/* Made by tunable.cmake from ${header}. */\n"
       "extern struct sunder_i_${name}_tuning {\n${members}} sunder_i_${name}_tuning;\n")
  file(WRITE ${OUTPUT}/${room}/tuning.h
       "/* Made by tunable.cmake from ${header}. */\n"
       "#ifndef SUNDER_I_${upper}_TUNABLE_H\n#define SUNDER_I_${upper}_TUNABLE_H\n\n"
       "#include \"src/${room}/tuning.h\"\n\n${undefine}\n#include \"${room}/tuning_struct.h\"\n\n${define}\n#endif\n")
  string(APPEND structs "#include \"${room}/tuning_struct.h\"\n")
  string(APPEND variables "struct sunder_i_${name}_tuning sunder_i_${name}_tuning = {\n${values}};\n\n")
endforeach()

file(WRITE ${OUTPUT}/constants.c
     "/* Made by tunable.cmake. */\n#include \"tuning.h\"\n\n${structs}\n${variables}"
     "const tunable tunables[] = {\n${table}};\nconst size_t tunables_n = sizeof tunables / sizeof *tunables;\n"
     "const tunable_room tunable_rooms[] = {\n${versions}};\n"
     "const size_t tunable_rooms_n = sizeof tunable_rooms / sizeof *tunable_rooms;\n")
