# rastercheck_library(FOLDER SOURCES…): the static library of one top-level folder,
# rastercheck_FOLDER, with the alias RasterCheck::FOLDER.
function(rastercheck_library folder)
  add_library(rastercheck_${folder} STATIC ${ARGN})
  add_library(RasterCheck::${folder} ALIAS rastercheck_${folder})
  target_link_libraries(rastercheck_${folder} PUBLIC rastercheck_options)
endfunction()
