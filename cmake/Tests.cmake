include(GoogleTest)

# rastercheck_test_program(PROGRAM FOLDER SOURCES…): a GoogleTest program, each test of it a CTest test
# labelled with the folder. RapidCheck's properties start from one seed, so that the same commit has
# the same result; run the program itself for other seeds.
function(rastercheck_test_program program folder)
  add_executable(${program} ${ARGN})
  target_link_libraries(${program} PRIVATE
    rastercheck_options rapidcheck GTest::gmock GTest::gtest_main)
  target_compile_definitions(${program} PRIVATE RASTERCHECK_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
  gtest_discover_tests(${program} TEST_PREFIX "${folder}."
    PROPERTIES LABELS ${folder} ENVIRONMENT RC_PARAMS=seed=1 DISCOVERY_TIMEOUT 60)
endfunction()

# rastercheck_tests(FOLDER SOURCES…): the program of one folder's tests. It sees the folder's internal
# headers, as only it may. The whole library is linked, so that nothing that registers itself is
# dropped.
function(rastercheck_tests folder)
  rastercheck_test_program(rastercheck_tests_${folder} ${folder} ${ARGN})
  target_link_libraries(rastercheck_tests_${folder} PRIVATE
    $<LINK_LIBRARY:WHOLE_ARCHIVE,RasterCheck::${folder}>)
endfunction()
