# Every outside library, in one place. All are packages of Debian 12 and 13 (scripts/packages.txt).

# The rasterizer's own dependencies; cmake/RasterCheckConfig.cmake.in has the same list.
find_package(glm REQUIRED)
find_package(hwy REQUIRED)
find_package(TBB REQUIRED)
find_package(Threads REQUIRED)
if(RASTERCHECK_ONLY_RASTERIZER)
  return()
endif()

set(CGAL_DO_NOT_WARN_ABOUT_CMAKE_BUILD_TYPE TRUE)
find_package(CGAL REQUIRED)
find_package(Eigen3 REQUIRED NO_MODULE)
find_package(fmt REQUIRED)
find_package(tl-expected REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(assimp REQUIRED)
find_package(CLI11 REQUIRED)
find_package(Boost REQUIRED)  # headers only
find_package(PNG REQUIRED)
find_package(OpenEXR REQUIRED)
find_package(rapidcheck REQUIRED)
find_package(Vulkan REQUIRED)
find_program(RASTERCHECK_GLSLANG glslangValidator REQUIRED)
# d3, which is embedded in every report.html.
find_file(RASTERCHECK_D3 d3.min.js PATHS /usr/share/nodejs/d3/dist NO_DEFAULT_PATH
  DOC "d3.min.js of d3 5 to 7, as Debian's node-d3 has it")
if(NOT RASTERCHECK_D3)
  message(FATAL_ERROR "d3.min.js is not in /usr/share/nodejs/d3/dist, where Debian's node-d3 has it: "
    "-DRASTERCHECK_D3=FILE says where it is")
endif()
# The Stanford bunny, which scripts/run, benchmarks and some tests draw.
find_file(RASTERCHECK_BUNNY bunny.obj PATHS /usr/share/glmark2/models NO_DEFAULT_PATH
  DOC "The Stanford bunny, as Debian's glmark2-data has it")
if(NOT RASTERCHECK_BUNNY)
  message(WARNING "bunny.obj is not in /usr/share/glmark2/models, where Debian's glmark2-data has it: "
    "-DRASTERCHECK_BUNNY=FILE says where it is; what draws it fails, all else works")
endif()

# libepoxy, which looks up OpenGL's functions at run time. It has no CMake package file.
find_path(RASTERCHECK_EPOXY_INCLUDE epoxy/egl.h REQUIRED)
find_library(RASTERCHECK_EPOXY_LIBRARY epoxy REQUIRED)
add_library(epoxy::epoxy UNKNOWN IMPORTED)
set_target_properties(epoxy::epoxy PROPERTIES
  IMPORTED_LOCATION "${RASTERCHECK_EPOXY_LIBRARY}"
  INTERFACE_INCLUDE_DIRECTORIES "${RASTERCHECK_EPOXY_INCLUDE}")

# libseccomp, for the processes that run foreign code. It has no CMake package file either.
find_path(RASTERCHECK_SECCOMP_INCLUDE seccomp.h REQUIRED)
find_library(RASTERCHECK_SECCOMP_LIBRARY seccomp REQUIRED)
add_library(seccomp::seccomp UNKNOWN IMPORTED)
set_target_properties(seccomp::seccomp PROPERTIES
  IMPORTED_LOCATION "${RASTERCHECK_SECCOMP_LIBRARY}"
  INTERFACE_INCLUDE_DIRECTORIES "${RASTERCHECK_SECCOMP_INCLUDE}")

if(RASTERCHECK_TESTS)
  find_package(GTest REQUIRED)
  find_package(benchmark REQUIRED)
  # Debian's interpreter: Debian's python3-jsonschema is installed for that one.
  find_program(RASTERCHECK_PYTHON python3 PATHS /usr/bin NO_DEFAULT_PATH REQUIRED)
  find_program(RASTERCHECK_PATCH patch REQUIRED)
endif()
