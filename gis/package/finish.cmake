# Run by cpack on each tree before it is packed: what Debian asks of a package and an installation by hand does not need.
# Manual pages are compressed; each package has its licence and its changes in /usr/share/doc/NAME.
cmake_policy(SET CMP0057 NEW)

function(compress file)
  execute_process(COMMAND gzip -9nf ${file} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

# The time of the last change that is known, so that the same sources make the same package.
function(package_date out)
  set(ENV{TZ} UTC)
  set(ENV{LC_ALL} C)
  if(DEFINED ENV{SOURCE_DATE_EPOCH})
    execute_process(COMMAND date -R -d @$ENV{SOURCE_DATE_EPOCH} OUTPUT_VARIABLE date OUTPUT_STRIP_TRAILING_WHITESPACE)
  else()
    execute_process(COMMAND date -R -r ${CPACK_SUNDER_SOURCE}/CHANGELOG.md OUTPUT_VARIABLE date
                    OUTPUT_STRIP_TRAILING_WHITESPACE)
  endif()
  set(${out} "${date}" PARENT_SCOPE)
endfunction()

function(write_doc name folder)
  file(READ ${CPACK_SUNDER_SOURCE}/LICENSE license)
  file(WRITE ${folder}/copyright "Sunder ${CPACK_PACKAGE_VERSION}\n\n${license}")
  package_date(date)
  file(WRITE ${folder}/changelog "${name} (${CPACK_PACKAGE_VERSION}) unstable; urgency=medium\n
  * Changes are listed in CHANGELOG.md of the sources.\n
 -- ${CPACK_PACKAGE_CONTACT}  ${date}\n")
  compress(${folder}/changelog)
  file(CHMOD ${folder}/copyright ${folder}/changelog.gz PERMISSIONS OWNER_READ OWNER_WRITE GROUP_READ WORLD_READ)
endfunction()

foreach(component IN LISTS CPACK_COMPONENTS_ALL)
  string(TOUPPER ${component} upper)
  set(name ${CPACK_DEBIAN_${upper}_PACKAGE_NAME})
  set(root ${CPACK_TEMPORARY_DIRECTORY}/${component}/usr)
  if(EXISTS ${root})
    write_doc(${name} ${root}/share/doc/${name})
    file(GLOB pages ${root}/share/man/man*/*.[0-9])
    foreach(page IN LISTS pages)
      compress(${page})
    endforeach()
  endif()
endforeach()
