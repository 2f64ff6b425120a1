# Installation: the program in bin, all that find_assets() of app/scene.cpp looks for under share/trocar.
include(GNUInstallDirs)
set(_trocar_share ${CMAKE_INSTALL_DATADIR}/trocar)
install(TARGETS trocar RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(DIRECTORY assets/ DESTINATION ${_trocar_share}/assets)
install(DIRECTORY scenarios/exercises/ DESTINATION ${_trocar_share}/exercises FILES_MATCHING PATTERN "*.toml")
install(DIRECTORY scenarios/hands/ DESTINATION ${_trocar_share}/hands FILES_MATCHING PATTERN "*.toml")
install(FILES LICENSE DESTINATION ${_trocar_share})
