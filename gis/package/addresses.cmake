# The addresses of the project, and of its maintainer. All are empty until a release is published; none is invented.
# Whoever
# publishes fills them in here, or passes -DSUNDER_HOMEPAGE=https://... and so on. From here they go into packages,
# pkg-config's file and the plug-in; `cmake -P gis/package/fill_addresses.cmake` writes them into README.md and
# SECURITY.md. What is empty is left out.
set(SUNDER_EMAIL "" CACHE STRING "Address of the maintainer, for packages and the plug-in")
set(SUNDER_HOMEPAGE "" CACHE STRING "Web page of the project")
set(SUNDER_TRACKER "" CACHE STRING "Web page where issues are reported")
set(SUNDER_REPOSITORY "" CACHE STRING "Web page of the source code")
set(SUNDER_PRIVATE_REPORTS "" CACHE STRING "Web page or address for private reports of vulnerabilities")
