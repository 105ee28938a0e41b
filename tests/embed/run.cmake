# Installs the package into an empty folder, builds the embedding program against it, and runs it on a small bake.
# Given: BUILD_FOLDER, SOURCE_FOLDER (this one), WORLDY (the binary), SANITIZE, COMPILER, GENERATOR (of CMake), DATA (an
# elevation image), COLOUR (a colour image).
file(REMOVE_RECURSE ${BUILD_FOLDER}/embed)
file(MAKE_DIRECTORY ${BUILD_FOLDER}/embed)

function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "${ARGN} failed:\n${output}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

set(flags "")
if(SANITIZE)
  set(flags "-fsanitize=${SANITIZE}")
endif()
run(${CMAKE_COMMAND} --install ${BUILD_FOLDER} --component planet --prefix ${BUILD_FOLDER}/embed/installed)
run(${CMAKE_COMMAND} -S ${SOURCE_FOLDER} -B ${BUILD_FOLDER}/embed/build -G ${GENERATOR} -DCMAKE_BUILD_TYPE=Release
    -DCMAKE_PREFIX_PATH=${BUILD_FOLDER}/embed/installed -DCMAKE_CXX_COMPILER=${COMPILER} -DCMAKE_CXX_FLAGS=${flags})
run(${CMAKE_COMMAND} --build ${BUILD_FOLDER}/embed/build)
run(${WORLDY} bake ${DATA} --colour ${COLOUR} --face-size 513 -o ${BUILD_FOLDER}/embed/earth.chk)
# The address sanitizer ignores leaks in the window system's drivers.
run(${CMAKE_COMMAND} -E env ASAN_OPTIONS=detect_leaks=0
    ${BUILD_FOLDER}/embed/build/embed ${BUILD_FOLDER}/embed/earth.chk 60)
message("${output}")
if(NOT output MATCHES "[1-9][0-9]* chunks, [1-9][0-9]* triangles")
  message(FATAL_ERROR "the embedding program drew nothing")
endif()
# More tiles than the six whole faces prove that they were streamed.
foreach(kind IN ITEMS chunks "colour tiles" "normal tiles")
  if(NOT output MATCHES "([7-9]|[1-9][0-9]+) resident ${kind}")
    message(FATAL_ERROR "the embedding program streamed no ${kind}")
  endif()
endforeach()

# The runtime needs no display and no image, task or graphics library.
run(${BUILD_FOLDER}/embed/build/runtime ${BUILD_FOLDER}/embed/earth.chk)
message("${output}")
if(NOT output MATCHES "([1-9][0-9]*) chunks, ([1-9][0-9]*) resident")
  message(FATAL_ERROR "the runtime selected nothing")
endif()
run(ldd ${BUILD_FOLDER}/embed/build/runtime)
if(output MATCHES "OpenImageIO|tbb|epoxy|libGL|libEGL|libtiff")
  message(FATAL_ERROR "the runtime is linked with more than it needs:\n${output}")
endif()
