# The components of an installed RasterCheck:
#
#   rasterizer  RasterCheck::rasterizer (docs/using-the-rasterizer.md)
#   testing     RasterCheck::testing and the libraries that it needs (docs/using-in-googletest.md)
#   plugin      rastercheck/plugin.h and barycentrics.h, which depend on nothing
#   corpus      the cases that the program and RasterCheck::testing check first
#   program     rastercheck, and the Python package of the same name (python/)
#
# The first two are also the components of find_package(RasterCheck) (RasterCheckConfig.cmake.in).
include(CMakePackageConfigHelpers)

set(RASTERCHECK_CORPUS "${CMAKE_INSTALL_DATADIR}/rastercheck/corpus")  # below the prefix
set(RASTERCHECK_KNOWN "${CMAKE_INSTALL_DATADIR}/rastercheck/known")
set(RASTERCHECK_ACCURACY "${CMAKE_INSTALL_DATADIR}/rastercheck/accuracy")

# rastercheck_install(FOLDER COMPONENT WHERE [EXCEPT HEADERS…]): installs the library of a folder,
# and its public headers into WHERE below the include folder. Users include headers as the project
# does: "FOLDER/….h".
function(rastercheck_install folder component where)
  cmake_parse_arguments(PARSE_ARGV 3 arg "" "" "EXCEPT")
  file(GLOB headers CONFIGURE_DEPENDS RELATIVE ${CMAKE_CURRENT_SOURCE_DIR} *.h)
  list(REMOVE_ITEM headers ${arg_EXCEPT})
  target_sources(rastercheck_${folder} PUBLIC
    FILE_SET HEADERS BASE_DIRS ${PROJECT_SOURCE_DIR} FILES ${headers})
  set_target_properties(rastercheck_${folder} PROPERTIES EXPORT_NAME ${folder})
  set(include_folder "${CMAKE_INSTALL_INCLUDEDIR}")
  if(NOT where STREQUAL ".")
    string(APPEND include_folder "/${where}")
  endif()
  install(TARGETS rastercheck_${folder} EXPORT RasterCheck-${component}
    ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT ${component}
    FILE_SET HEADERS DESTINATION "${include_folder}" COMPONENT ${component})
endfunction()

# rastercheck_install_package(COMPONENTS…): installs the files by which find_package(RasterCheck)
# finds these components. The package's own files belong to the rasterizer, which the other
# components need.
function(rastercheck_install_package)
  set(package_folder "${CMAKE_INSTALL_LIBDIR}/cmake/RasterCheck")
  foreach(component IN LISTS ARGN)
    install(EXPORT RasterCheck-${component} NAMESPACE RasterCheck::
      DESTINATION "${package_folder}" COMPONENT ${component})
  endforeach()
  # Generates the file in CMakeFiles/, where find_package() does not find it. find_package() also
  # looks beside the folders on the PATH, and a build's bin/ may be one of these.
  configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/RasterCheckConfig.cmake.in
    ${PROJECT_BINARY_DIR}/CMakeFiles/RasterCheckConfig.cmake INSTALL_DESTINATION "${package_folder}")
  write_basic_package_version_file(${PROJECT_BINARY_DIR}/CMakeFiles/RasterCheckConfigVersion.cmake
    COMPATIBILITY SameMinorVersion)
  install(FILES
    ${PROJECT_BINARY_DIR}/CMakeFiles/RasterCheckConfig.cmake
    ${PROJECT_BINARY_DIR}/CMakeFiles/RasterCheckConfigVersion.cmake
    DESTINATION "${package_folder}" COMPONENT rasterizer)
endfunction()
