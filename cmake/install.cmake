# Programs are installed where they are made (cpp/); this is what they need at run time: scenarios and the page.
install(DIRECTORY ${PROJECT_SOURCE_DIR}/scripts/scenarios DESTINATION ${CMAKE_INSTALL_DATADIR}/skein OPTIONAL)
# Built by npm, so it may not be there.
install(DIRECTORY ${PROJECT_SOURCE_DIR}/web/dist/ DESTINATION ${CMAKE_INSTALL_DATADIR}/skein/web OPTIONAL)
