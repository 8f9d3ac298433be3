# What cpack makes Debian packages of: the program, the library, what is needed to build on it, the QGIS plug-in, and the
# package for Python.
#
#   cmake --preset package && cmake --build --preset package && (cd build/package && cpack)
#
# Dependencies are read off the binaries (dpkg-shlibdeps), so a package is for the release of Debian on which it was made.
# Who hands packages on gives an address that is read (addresses.cmake), or both: -DSUNDER_MAINTAINER="Name <address>".
set(SUNDER_MAINTAINER "" CACHE STRING "Maintainer of the packages; empty: the authors, at SUNDER_EMAIL")
if(SUNDER_MAINTAINER)
  set(maintainer "${SUNDER_MAINTAINER}")
elseif(SUNDER_EMAIL)
  set(maintainer "The Sunder authors <${SUNDER_EMAIL}>")
else()
  set(maintainer "The Sunder authors")
endif()

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME sunder)
set(CPACK_PACKAGE_VENDOR "The Sunder authors")
set(CPACK_PACKAGE_CONTACT "${maintainer}")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE
    WORLD_READ WORLD_EXECUTE)
set(CPACK_COMPONENTS_ALL library development)
if(SUNDER_PROGRAM)
  list(APPEND CPACK_COMPONENTS_ALL program qgis-plugin)
endif()
if(TARGET sunder_python)
  list(APPEND CPACK_COMPONENTS_ALL python)
endif()
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_MAINTAINER "${maintainer}")
if(SUNDER_HOMEPAGE)
  set(CPACK_DEBIAN_PACKAGE_HOMEPAGE "${SUNDER_HOMEPAGE}")
endif()
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_PRE_BUILD_SCRIPTS ${CMAKE_CURRENT_LIST_DIR}/finish.cmake)
# For finish.cmake, which sees these.
set(CPACK_SUNDER_SOURCE ${PROJECT_SOURCE_DIR})

set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME sunder)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION science)
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION
    "takes overlapping features of a map apart, provably little
Moves the features of a GIS layer apart until no two of them overlap or are
nearer than a gap, at a cost beside which a proved lower bound stands; and
computes Minkowski sums and buffers of polygons, exactly. Reads and writes
whatever GDAL does.")

set(CPACK_DEBIAN_LIBRARY_PACKAGE_NAME libsunder${PROJECT_VERSION_MAJOR})
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SECTION libs)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_CONTROL_EXTRA ${CMAKE_CURRENT_LIST_DIR}/triggers)
set(CPACK_COMPONENT_LIBRARY_DESCRIPTION
    "exact Minkowski sums and small displacements of map features: library
The shared library: Minkowski sums of polygonal sets with their degenerate
holes, least separating translations, displacement of whole layers. It needs
GMP alone.")

set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libsunder-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "libsunder${PROJECT_VERSION_MAJOR} (= ${PROJECT_VERSION}), libgmp-dev")
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION
    "exact Minkowski sums and small displacements of map features: headers
The header, the static library, and what pkg-config and CMake ask for.")

set(CPACK_DEBIAN_QGIS-PLUGIN_PACKAGE_NAME qgis-plugin-sunder)
set(CPACK_DEBIAN_QGIS-PLUGIN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_QGIS-PLUGIN_PACKAGE_ARCHITECTURE all)
set(CPACK_DEBIAN_QGIS-PLUGIN_PACKAGE_SHLIBDEPS OFF)
set(CPACK_DEBIAN_QGIS-PLUGIN_PACKAGE_DEPENDS "sunder (>= ${PROJECT_VERSION}), qgis (>= 3.22)")
set(CPACK_DEBIAN_QGIS-PLUGIN_PACKAGE_CONTROL_EXTRA ${CMAKE_CURRENT_LIST_DIR}/prerm)
set(CPACK_COMPONENT_QGIS-PLUGIN_DESCRIPTION
    "takes overlapping features of a map apart: plug-in for QGIS
The commands of the program sunder as algorithms of the Processing toolbox.
Once installed it is switched on in Plugins, Manage and Install Plugins.")

set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-sunder)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "python3 (>= 3.11)")
set(CPACK_DEBIAN_PYTHON_PACKAGE_RECOMMENDS "python3-geopandas, python3-numpy, python3-shapely")
set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA ${CMAKE_CURRENT_LIST_DIR}/python/prerm)
set(CPACK_COMPONENT_PYTHON_DESCRIPTION
    "takes overlapping features of a map apart: package for Python
Exact Minkowski sums, least translations, routes, and the displacement of
whole layers, for geometries of Shapely and GeoPandas or plain arrays. The
library is part of the package; it needs GMP alone.")

include(CPack)
