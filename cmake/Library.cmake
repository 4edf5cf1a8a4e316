# rastercheck_library(FOLDER SOURCES…): adds the static library of one folder, rastercheck_FOLDER,
# with the alias RasterCheck::FOLDER. The project's compile options stay within the project: users
# get them neither from an installed library nor if they build the rasterizer as part of their own
# project.
function(rastercheck_library folder)
  add_library(rastercheck_${folder} STATIC ${ARGN})
  add_library(RasterCheck::${folder} ALIAS rastercheck_${folder})
  target_compile_features(rastercheck_${folder} PUBLIC cxx_std_20)
  if(RASTERCHECK_ONLY_RASTERIZER)
    target_link_libraries(rastercheck_${folder} PRIVATE $<BUILD_INTERFACE:rastercheck_options>)
  else()
    target_link_libraries(rastercheck_${folder} PUBLIC $<BUILD_INTERFACE:rastercheck_options>)
  endif()
endfunction()

# rastercheck_compile_quickly(TARGET [DEBUG_ONLY]): barely optimises a target that mostly waits for
# others, or runs once per run: a short build matters more there than fast code. With DEBUG_ONLY,
# release builds stay fast. Clang compiles such code in half of the time if it does not optimise
# what sanitizers insert.
function(rastercheck_compile_quickly target)
  if(NOT "DEBUG_ONLY" IN_LIST ARGN)
    target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
  endif()
  target_compile_options(${target} PRIVATE
    $<$<AND:$<CONFIG:Debug>,$<CXX_COMPILER_ID:Clang>>:-O0>)
endfunction()

# rastercheck_precompile(TARGET HEADERS…): precompiles for a target these headers of other
# libraries, and the headers of the standard library that most files need. They take most of the
# compile time. Never the project's own headers: a change of one would recompile everything. With
# GCC only: clang-tidy reads the commands of a Clang build, and cannot read headers that another
# version has precompiled; a Clang build also notices a missing #include. Unity builds (all presets
# but `dev` and `coverage`) share headers anyway.
# rastercheck_precompile(TARGET REUSE_FROM OTHER): has the target use what was precompiled for
# another target, which must be compiled with the same options.
function(rastercheck_precompile target)
  cmake_parse_arguments(PARSE_ARGV 1 given "" "REUSE_FROM" "")
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND NOT CMAKE_UNITY_BUILD)
    target_compile_options(${target} PRIVATE
      -fpch-preprocess  # required by ccache
      # GCC 12 no longer treats a precompiled std::string as a system header, and warns about its
      # code (GCC bug 105651). Clang builds, which precompile nothing, still warn.
      -Wno-stringop-overflow -Wno-stringop-overread -Wno-array-bounds)
    if(given_REUSE_FROM)
      target_precompile_headers(${target} REUSE_FROM ${given_REUSE_FROM})
    else()
      target_precompile_headers(${target} PRIVATE
        <algorithm> <array> <functional> <map> <optional> <span> <string> <vector>
        ${given_UNPARSED_ARGUMENTS})
    endif()
  endif()
endfunction()
