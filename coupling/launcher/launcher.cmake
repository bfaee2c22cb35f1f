# What the launcher tells of itself (version, commit, compiler flags, libraries), renewed at every build, and where the
# report scripts are installed. Included by coupling/CMakeLists.txt after the libraries.
set(STANDOFF_FACT_HEADER ${CMAKE_BINARY_DIR}/standoff_build_facts.hpp)
string(TOUPPER "${CMAKE_BUILD_TYPE}" standoff_build_type)
string(STRIP "${CMAKE_CXX_FLAGS} ${CMAKE_CXX_FLAGS_${standoff_build_type}}" standoff_flags)
if(STANDOFF_SANITIZE)
  string(APPEND standoff_flags " -fsanitize=${STANDOFF_SANITIZE}")
endif()
string(APPEND standoff_flags "; numerics: -mavx2 -mfma -ffp-contract=off")
set(standoff_write_facts ${CMAKE_COMMAND}
  -DHEADER=${STANDOFF_FACT_HEADER} -DSOURCE=${CMAKE_SOURCE_DIR} -DVERSION=${PROJECT_VERSION} "-DFLAGS=${standoff_flags}"
  "-DLIBRARIES=Eigen ${Eigen3_VERSION}|protobuf ${Protobuf_VERSION}|cppzmq ${cppzmq_VERSION}|SUNDIALS ${SUNDIALS_VERSION}|toml++ ${tomlplusplus_VERSION}|CLI11 ${CLI11_VERSION}|nlohmann_json ${nlohmann_json_VERSION}|fmt ${fmt_VERSION}|zlib ${ZLIB_VERSION_STRING}"
  -P ${CMAKE_CURRENT_LIST_DIR}/write_build_facts.cmake)
# Once now, so that the header exists when dependencies are scanned; then before every build of the launcher.
execute_process(COMMAND ${standoff_write_facts})
add_custom_target(standoff_build_facts COMMAND ${standoff_write_facts} BYPRODUCTS ${STANDOFF_FACT_HEADER} VERBATIM)
add_dependencies(standoff_launcher standoff_build_facts)
install(FILES ${CMAKE_SOURCE_DIR}/coupling/report/cell_figure.py ${CMAKE_SOURCE_DIR}/coupling/report/cost_figure.py ${CMAKE_SOURCE_DIR}/coupling/report/cost_effects_figure.py
              ${CMAKE_SOURCE_DIR}/coupling/report/flow_figure.py ${CMAKE_SOURCE_DIR}/coupling/report/run_figure.py
              ${CMAKE_SOURCE_DIR}/coupling/report/run_report.py
              ${CMAKE_SOURCE_DIR}/coupling/report/wall_figure.py
        DESTINATION ${CMAKE_INSTALL_DATADIR}/standoff/report)
