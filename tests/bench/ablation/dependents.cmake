# Which files of the library see a constant that can be changed, or ask whether a stage is on?
#
#   sunder_ablation_dependents(VARIABLE SOURCE)
#
# sets VARIABLE to those .c files below the folder SOURCE that include a tuning.h or stage_switch.h, directly or through
# another header. Headers are told apart by their names without folders: one of the same name adds files at most. A new
# include is seen when CMake runs again.

function(sunder_ablation_select out names) # of the further arguments, the files that include a header of these names
  set(found)
  foreach(file IN LISTS ARGN)
    file(STRINGS ${file} line REGEX "^#include \"(.*/)?(${names})[.]h\"" LIMIT_COUNT 1)
    if(line)
      list(APPEND found ${file})
    endif()
  endforeach()
  set(${out} ${found} PARENT_SCOPE)
endfunction()

function(sunder_ablation_dependents out source)
  file(GLOB_RECURSE headers CONFIGURE_DEPENDS ${source}/*.h)
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${source}/*.c)
  set(names "tuning|stage_switch")
  set(before "")
  while(NOT names STREQUAL before)
    set(before "${names}")
    sunder_ablation_select(found "${before}" ${headers})
    set(names "tuning|stage_switch")
    foreach(header IN LISTS found)
      get_filename_component(name ${header} NAME_WE)
      string(APPEND names "|${name}")
    endforeach()
  endwhile()
  sunder_ablation_select(found "${names}" ${sources})
  set(${out} ${found} PARENT_SCOPE)
endfunction()
