# rastercheck_library(FOLDER SOURCES…): the static library of one top-level folder,
# rastercheck_FOLDER, with the alias RasterCheck::FOLDER. What the project is compiled with is for the
# project: an installed library has no say in its users' flags, nor has one that is part of theirs.
function(rastercheck_library folder)
  add_library(rastercheck_${folder} STATIC ${ARGN})
  add_library(RasterCheck::${folder} ALIAS rastercheck_${folder})
  if(RASTERCHECK_ONLY_RASTERIZER)
    target_link_libraries(rastercheck_${folder} PRIVATE $<BUILD_INTERFACE:rastercheck_options>)
  else()
    target_link_libraries(rastercheck_${folder} PUBLIC $<BUILD_INTERFACE:rastercheck_options>)
  endif()
endfunction()
