trocar_test(test_run_screen_parts
  SOURCES ${CMAKE_CURRENT_LIST_DIR}/coach_test.cpp ${CMAKE_CURRENT_LIST_DIR}/hud_words_test.cpp ${CMAKE_CURRENT_LIST_DIR}/run_view_test.cpp
  LINK trocar_screens)
trocar_test(test_run_screen
  SOURCES ${CMAKE_CURRENT_LIST_DIR}/run_screen_test.cpp
  LINK trocar_screens)
