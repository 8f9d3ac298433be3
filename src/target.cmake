# Refuses, with a sentence, a target for which the sources would be wrong or would not compile. Nothing is linked and
# nothing is run, so it works for other machines, too.

# Does the compiler, with the build's own flags, say that the expressions are not zero?
function(sunder_target_holds out include) # further arguments: expressions
  list(JOIN ARGN " && " expression)
  set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)
  set(assertion ${CMAKE_CURRENT_BINARY_DIR}/assertion.c)
  file(WRITE ${assertion} "${include}\n_Static_assert(${expression}, \"\");\nextern int unused;\n")
  try_compile(holds ${CMAKE_CURRENT_BINARY_DIR}/assertion SOURCES ${assertion}
              CMAKE_FLAGS "-DINCLUDE_DIRECTORIES=${GMP_INCLUDE_DIR}")
  set(${out} ${holds} PARENT_SCOPE)
endfunction()

function(sunder_target_needs include expression) # further arguments: the sentence, in pieces
  sunder_target_holds(holds "${include}" "${expression}")
  if(NOT holds)
    string(JOIN " " sentence ${ARGN})
    message(FATAL_ERROR "Sunder cannot be built for this target: ${sentence}")
  endif()
endfunction()

# Before GMP is looked for, which is not found for a target that CMake does not know well.
function(sunder_target_check_compiler)
  set(wide "sizeof(wide) == 16")
  set(typedef "__extension__ typedef __int128 wide;")
  set(words "sizeof(long) == 8 && sizeof(long long) == 8 && sizeof(void *) == 8")
  set(doubles "FLT_RADIX == 2 && DBL_MANT_DIG == 53 && DBL_MAX_EXP == 1024 && FLT_EVAL_METHOD == 0")
  set(integers "(-1 >> 1) == -1 && (int)~0u == -1")
  sunder_target_holds(holds "#include <float.h>\n${typedef}" ${wide} ${words} ${doubles} ${integers})
  if(holds)
    return()
  endif()
  sunder_target_needs("" "1" "${CMAKE_C_COMPILER} takes no _Static_assert of C11 with the flags '${CMAKE_C_FLAGS}'.")
  sunder_target_needs("${typedef}" "${wide}" "its compiler has no __int128, which products of coordinates need."
                      "Build for a 64-bit machine, with gcc or clang.")
  sunder_target_needs("" "${words}" "its long and its pointers do not have 64 bits."
                      "Build for a 64-bit machine whose data model is LP64.")
  sunder_target_needs("#include <float.h>" "${doubles}"
                      "its doubles are not the 64 bits of IEEE 754, or are computed with excess precision"
                      "(FLT_EVAL_METHOD is not 0), so the error bounds of the filters do not hold.")
  sunder_target_needs("" "${integers}" "its signed integers are not shifted and converted as two's complement.")
endfunction()

function(sunder_target_check_gmp)
  set(limbs "GMP_LIMB_BITS == 64 && GMP_NAIL_BITS == 0 && sizeof(mp_limb_t) == 8")
  sunder_target_holds(holds "#include <gmp.h>" ${limbs})
  if(holds)
    return()
  endif()
  sunder_target_needs("#include <gmp.h>" "1" "${GMP_INCLUDE_DIR}/gmp.h does not compile. Install GMP for this target.")
  sunder_target_needs("#include <gmp.h>" "${limbs}"
                      "the limbs of its GMP, ${GMP_INCLUDE_DIR}/gmp.h, do not have 64 bits."
                      "Install a GMP that is built with 64-bit limbs and without nails.")
endfunction()
