# The compile options of every target of the project: one INTERFACE target, rastercheck_options.

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
  # A fused multiply-add gives a different number, so only explicit calls in the source may fuse.
  -ffp-contract=off
  # GCC 12 warns of overlaps in std::string's operator+ that do not exist (GCC bug 105651).
  $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>
  # In a unity build, GCC treats sources as headers and compares their names with each other, so
  # these two warnings are false. Builds that compile each source by itself keep both warnings.
  $<$<BOOL:${CMAKE_UNITY_BUILD}>:-Wno-shadow>
  $<$<AND:$<BOOL:${CMAKE_UNITY_BUILD}>,$<CXX_COMPILER_ID:GNU>>:-Wno-subobject-linkage>
  $<$<BOOL:${RASTERCHECK_WERROR}>:-Werror>)

if(CMAKE_SYSTEM_PROCESSOR MATCHES "aarch64|arm64")
  # The kernels keep vectors in structures, which SVE's vectors of unknown length do not allow, so
  # only NEON remains. Highway 1.0's NEON needs processors with AES, so every arm64 build does. The
  # flag is for all files, because constructors that the compiler adds to structures of vectors are
  # compiled with the file's flags, not with the kernel's.
  target_compile_definitions(rastercheck_options INTERFACE
    "HWY_DISABLED_TARGETS=(HWY_SVE|HWY_SVE2|HWY_SVE_256|HWY_SVE2_128)")
  target_compile_options(rastercheck_options INTERFACE -march=armv8-a+crypto)
elseif((RASTERCHECK_SANITIZE OR RASTERCHECK_COVERAGE) AND NOT RASTERCHECK_ALL_VECTORS)
  # Instrumented kernels take minutes to compile for each SIMD target. On x86 the remaining targets
  # have four lanes (SSE2, or no vector instructions) and eight (AVX2). Better targets have lower
  # bits, so HWY_AVX2 − 1 disables all that are better than AVX2.
  target_compile_definitions(rastercheck_options INTERFACE
    "HWY_DISABLED_TARGETS=(HWY_SSSE3|HWY_SSE4|(HWY_AVX2-1))")
endif()
if(RASTERCHECK_COVERAGE)
  # Counts from several threads must be consistent: gcov derives some counts from others.
  target_compile_options(rastercheck_options INTERFACE --coverage -fprofile-update=atomic)
  target_link_options(rastercheck_options INTERFACE --coverage)
endif()
if(RASTERCHECK_SANITIZE)
  target_compile_options(rastercheck_options INTERFACE
    -fsanitize=${RASTERCHECK_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  target_link_options(rastercheck_options INTERFACE -fsanitize=${RASTERCHECK_SANITIZE})
endif()
