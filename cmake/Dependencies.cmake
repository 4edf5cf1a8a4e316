# Every outside library, in one place. All are Debian 12 packages (scripts/packages.txt).

set(CGAL_DO_NOT_WARN_ABOUT_CMAKE_BUILD_TYPE TRUE)
find_package(CGAL REQUIRED)
find_package(Eigen3 REQUIRED NO_MODULE)
find_package(fmt REQUIRED)
find_package(glm REQUIRED)
find_package(hwy REQUIRED)
find_package(tl-expected REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(assimp REQUIRED)
find_package(CLI11 REQUIRED)
find_package(Boost REQUIRED)  # headers only
find_package(PNG REQUIRED)
find_package(rapidcheck REQUIRED)
find_package(Threads REQUIRED)

if(RASTERCHECK_TESTS)
  find_package(GTest REQUIRED)
  find_package(benchmark REQUIRED)
  # Debian's interpreter, the one its python3-jsonschema is installed for.
  find_program(RASTERCHECK_PYTHON python3 PATHS /usr/bin NO_DEFAULT_PATH REQUIRED)
  find_program(RASTERCHECK_PATCH patch REQUIRED)
endif()
