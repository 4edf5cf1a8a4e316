# What every target of the project is compiled with: one INTERFACE target, rastercheck_options.

option(RASTERCHECK_ONLY_RASTERIZER "Build RasterCheck::rasterizer alone, without tests" OFF)
option(RASTERCHECK_TESTS "Build the tests" ON)
option(RASTERCHECK_WERROR "Treat warnings as errors" OFF)
option(RASTERCHECK_ALL_VECTORS "Instrumented builds, too, have kernels for every kind of vectors" OFF)
set(RASTERCHECK_SANITIZE "" CACHE STRING "Sanitizers for every target, as -fsanitize takes them")
option(RASTERCHECK_FUZZ "Build the fuzz targets with libFuzzer, which clang has" OFF)
option(RASTERCHECK_COVERAGE "Instrument for gcov" OFF)

set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/bin")
set(CMAKE_ARCHIVE_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/lib")

add_library(rastercheck_options INTERFACE)
target_compile_features(rastercheck_options INTERFACE cxx_std_20)
target_include_directories(rastercheck_options INTERFACE "${PROJECT_SOURCE_DIR}")
target_compile_options(rastercheck_options INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wsign-conversion -Wold-style-cast
  -Wcast-qual -Wnon-virtual-dtor -Woverloaded-virtual
  -Wimplicit-fallthrough -Wundef
  # A fused multiply-add is a different number: it stands only where the source says so.
  -ffp-contract=off
  # GCC 12 sees overlaps in std::string's operator+ that are not there (GCC bug 105651).
  $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>
  # In a unity build GCC takes a source for a header, and compares its names with those of other sources:
  # builds that compile each by itself look for these two.
  $<$<BOOL:${CMAKE_UNITY_BUILD}>:-Wno-shadow>
  $<$<AND:$<BOOL:${CMAKE_UNITY_BUILD}>,$<CXX_COMPILER_ID:GNU>>:-Wno-subobject-linkage>
  $<$<BOOL:${RASTERCHECK_WERROR}>:-Werror>)

if((RASTERCHECK_SANITIZE OR RASTERCHECK_COVERAGE) AND NOT RASTERCHECK_ALL_VECTORS)
  # Instrumented kernels take minutes to compile for each kind of vectors. On x86 those that stay have
  # four lanes and eight: SSE2's or none, and AVX2's. Better ones are lower bits.
  target_compile_definitions(rastercheck_options INTERFACE
    "HWY_DISABLED_TARGETS=(HWY_SSSE3|HWY_SSE4|(HWY_AVX2-1))")
endif()
if(RASTERCHECK_COVERAGE)
  # What threads count has to add up: gcov works out some counts from others.
  target_compile_options(rastercheck_options INTERFACE --coverage -fprofile-update=atomic)
  target_link_options(rastercheck_options INTERFACE --coverage)
endif()
if(RASTERCHECK_SANITIZE)
  target_compile_options(rastercheck_options INTERFACE
    -fsanitize=${RASTERCHECK_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  target_link_options(rastercheck_options INTERFACE -fsanitize=${RASTERCHECK_SANITIZE})
endif()
