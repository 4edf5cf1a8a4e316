# `cpack -G DEB` in a build folder makes two Debian packages: rastercheck, the program with its corpus
# and its Python package, and rastercheck-dev, the files for find_package(RasterCheck). Install.cmake
# lists the components.
if(NOT PROJECT_IS_TOP_LEVEL)
  return()
endif()

set(package_docs "${CMAKE_INSTALL_DATADIR}/doc")
install(FILES README.md DESTINATION "${package_docs}/rastercheck" COMPONENT program)
install(DIRECTORY docs DESTINATION "${package_docs}/rastercheck" COMPONENT program
  PATTERN gate.sh PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
install(FILES LICENSE DESTINATION "${package_docs}/rastercheck" RENAME copyright COMPONENT program)
# The licence of d3, which is embedded in every report.html.
install(FILES /usr/share/doc/node-d3/copyright DESTINATION "${package_docs}/rastercheck"
  RENAME copyright.d3 COMPONENT program OPTIONAL)
install(FILES LICENSE DESTINATION "${package_docs}/rastercheck-dev" RENAME copyright
  COMPONENT rasterizer)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME rastercheck)
set(CPACK_PACKAGE_CONTACT "The RasterCheck authors")
set(CPACK_VERBATIM_VARIABLES TRUE)
set(CPACK_STRIP_FILES TRUE)
set(CPACK_DEB_COMPONENT_INSTALL TRUE)
# The first line of each package's description is the project's description; the rest is set here.
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_COMPONENTS_ALL program corpus rasterizer testing plugin)
set(CPACK_COMPONENT_PROGRAM_GROUP program)
set(CPACK_COMPONENT_CORPUS_GROUP program)
set(CPACK_COMPONENT_RASTERIZER_GROUP dev)
set(CPACK_COMPONENT_TESTING_GROUP dev)
set(CPACK_COMPONENT_PLUGIN_GROUP dev)

set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME rastercheck)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PROGRAM_DESCRIPTION
  "Computes what a drawn triangle has to be - every covered sample, every depth, every attribute - in exact
rational arithmetic, holds what a rasterizer draws against it, on a corpus and on random cases, and shows
what is wrong as a case of a few pixels.")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS TRUE)
# The libraries that the program loads to judge a driver, and Mesa's drivers.
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS "libegl1, libopengl0, libgles2, libgl1-mesa-dri, mesa-vulkan-drivers")
# For the Python package, which the program does without.
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS "python3 (>= 3.11), python3-hypothesis, python3-numpy, python3-pytest")

# The corpus comes with the program, of the same version. RasterCheckConfig.cmake.in looks for the
# rest.
set(CPACK_DEBIAN_DEV_PACKAGE_NAME rastercheck-dev)
set(CPACK_DEBIAN_DEV_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEV_DESCRIPTION
  "For programs in C++ built with CMake: RasterCheck's own rasterizer, and its properties as GoogleTest cases of
any class that draws.")
set(CPACK_DEBIAN_DEV_PACKAGE_DEPENDS
  "rastercheck (= ${PROJECT_VERSION})" libexpected-dev libfmt-dev libglm-dev libgmp-dev libgtest-dev
  libhwy-dev libmpfr-dev librapidcheck-dev libseccomp-dev libtbb-dev nlohmann-json3-dev)
list(JOIN CPACK_DEBIAN_DEV_PACKAGE_DEPENDS ", " CPACK_DEBIAN_DEV_PACKAGE_DEPENDS)
include(CPack)
