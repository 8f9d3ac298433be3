# Where the project is found and who answers: given to the build by whoever hands packages or the plug-in on, in this file
# or as -DSUNDER_HOMEPAGE=https://... and so on. What is empty is left out of what is made; none is invented.
set(SUNDER_EMAIL "" CACHE STRING "Address of the maintainer, for packages and the plug-in")
set(SUNDER_HOMEPAGE "" CACHE STRING "Web page of the project")
set(SUNDER_TRACKER "" CACHE STRING "Web page where issues are reported")
set(SUNDER_REPOSITORY "" CACHE STRING "Web page of the source code")
