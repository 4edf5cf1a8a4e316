# rastercheck_library(FOLDER SOURCES…): the static library of one top-level folder,
# rastercheck_FOLDER, with the alias RasterCheck::FOLDER. What the project is compiled with is for the
# project: an installed library has no say in its users' flags, nor has one that is part of theirs.
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

# rastercheck_precompile(TARGET HEADERS…): the standard library's and other libraries' headers that most
# of a target's files need and that take most of their time, compiled once for all of them; never the
# project's own, so that a change of one compiles just what includes it. With GCC only: clang-tidy reads
# the commands of a Clang build, which also sees what lacks an include, and not what another version
# precompiled. Unity builds (all presets but `dev` and `coverage`) share headers without it.
function(rastercheck_precompile target)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND NOT CMAKE_UNITY_BUILD)
    target_compile_options(${target} PRIVATE
      -fpch-preprocess  # as ccache wants it
      # GCC 12 forgets that a precompiled std::string is not the project's, and warns of its inside
      # (GCC bug 105651). Clang's builds, which precompile nothing, keep watch.
      -Wno-stringop-overflow -Wno-stringop-overread -Wno-array-bounds)
    target_precompile_headers(${target} PRIVATE
      <algorithm> <array> <functional> <map> <optional> <span> <string> <vector> ${ARGN})
  endif()
endfunction()
