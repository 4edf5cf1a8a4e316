include(GoogleTest)

# rastercheck_test_program(PROGRAM FOLDER SOURCES…): adds a GoogleTest program; each of its tests is
# a CTest test labelled with the folder. RapidCheck's properties start from a fixed seed, so that a
# commit always has the same result; for other seeds run the program itself.
function(rastercheck_test_program program folder)
  add_executable(${program} ${ARGN})
  target_link_libraries(${program} PRIVATE
    rastercheck_options rapidcheck GTest::gmock GTest::gtest_main)
  target_compile_definitions(${program} PRIVATE RASTERCHECK_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
  gtest_discover_tests(${program} TEST_PREFIX "${folder}."
    PROPERTIES LABELS ${folder} ENVIRONMENT RC_PARAMS=seed=1 DISCOVERY_TIMEOUT 60)
endfunction()

# rastercheck_tests(FOLDER SOURCES…): adds the program of one folder's tests. Links the whole
# library, so that the linker drops nothing that registers itself.
function(rastercheck_tests folder)
  rastercheck_test_program(rastercheck_tests_${folder} ${folder} ${ARGN})
  target_link_libraries(rastercheck_tests_${folder} PRIVATE
    $<LINK_LIBRARY:WHOLE_ARCHIVE,RasterCheck::${folder}>)
endfunction()
