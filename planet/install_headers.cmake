# Installs the headers that programs include, and those that they include in turn; the rest is private. Run by
# `cmake --install`, so that it follows the includes as they are then. Given: SOURCE (this folder), DESTINATION.
cmake_minimum_required(VERSION 3.23)
set(pending
  planet.h planet_tools.h spans/span_recorder.h chunk_explanation.h select/lod_select.h select/governor.h select/prediction.h base/atomic_file.h
  source/height_source.h source/colour_source.h bake/bake.h bake/file_report.h
  measure/true_error.h measure/edge_gaps.h measure/pop_meter.h measure/pick.h
  trace/lod_trace.h
  gl/draw/planet_renderer.h gl/draw/chunk_programs.h gl/device/gl_worker.h gl/measure/crack_meter.h)
set(installed)
while(pending)
  list(POP_FRONT pending header)
  if(header IN_LIST installed)
    continue()
  endif()
  list(APPEND installed ${header})
  get_filename_component(folder ${header} DIRECTORY)
  file(INSTALL ${SOURCE}/${header} DESTINATION ${DESTINATION}/${folder})
  file(STRINGS ${SOURCE}/${header} includes REGEX "^#include \"planet/")
  foreach(line IN LISTS includes)
    string(REGEX REPLACE "^#include \"planet/([^\"]+)\".*" "\\1" included "${line}")
    list(APPEND pending ${included})
  endforeach()
endwhile()
