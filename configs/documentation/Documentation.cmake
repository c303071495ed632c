# Man pages and bash completion of every tool, generated from its --help: targets `man` and `completion`, both installed.
find_program(HELP2MAN help2man REQUIRED)

get_property(tools GLOBAL PROPERTY VSGL_TOOLS)
set(man_folder ${PROJECT_BINARY_DIR}/share/man/man1)
set(completion_folder ${PROJECT_BINARY_DIR}/share/bash-completion/completions)
file(MAKE_DIRECTORY ${man_folder} ${completion_folder})

set(man_pages "")
set(completions "")
foreach(tool ${tools})
  add_custom_command(OUTPUT ${man_folder}/${tool}.1
    COMMAND ${Python3_EXECUTABLE} ${CMAKE_CURRENT_LIST_DIR}/manual.py --help2man ${HELP2MAN}
            --tool $<TARGET_FILE:${tool}> --output ${man_folder}/${tool}.1
    DEPENDS ${tool} ${CMAKE_CURRENT_LIST_DIR}/manual.py ${CMAKE_CURRENT_LIST_DIR}/help_text.py
    COMMENT "Writing the man page of ${tool}" VERBATIM)
  add_custom_command(OUTPUT ${completion_folder}/${tool}
    COMMAND ${Python3_EXECUTABLE} ${CMAKE_CURRENT_LIST_DIR}/completion.py
            --tool $<TARGET_FILE:${tool}> --output ${completion_folder}/${tool}
    DEPENDS ${tool} ${CMAKE_CURRENT_LIST_DIR}/completion.py ${CMAKE_CURRENT_LIST_DIR}/help_text.py
    COMMENT "Writing the bash completion of ${tool}" VERBATIM)
  list(APPEND man_pages ${man_folder}/${tool}.1)
  list(APPEND completions ${completion_folder}/${tool})
endforeach()

add_custom_target(man ALL DEPENDS ${man_pages})
add_custom_target(completion ALL DEPENDS ${completions})
install(FILES ${man_pages} DESTINATION share/man/man1)
install(FILES ${completions} DESTINATION share/bash-completion/completions)
