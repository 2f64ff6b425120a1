# Installation rules: program, assets, exercises.
include(GNUInstallDirs)
install(TARGETS trocar RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(DIRECTORY assets/ DESTINATION ${CMAKE_INSTALL_DATADIR}/trocar/assets)
install(DIRECTORY scenarios/exercises/ DESTINATION ${CMAKE_INSTALL_DATADIR}/trocar/exercises)
