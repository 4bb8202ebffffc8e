# Writes app/version.h with the git revision of the moment; run at every build, touches the file only on change.
execute_process(COMMAND git describe --always --dirty WORKING_DIRECTORY ${SOURCE_DIR}
  OUTPUT_VARIABLE SCORIA_REVISION OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE failed)
if(failed)
  set(SCORIA_REVISION unknown)
endif()
configure_file(${SOURCE_DIR}/app/version.h.in ${OUTPUT} @ONLY)
