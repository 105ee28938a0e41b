# Writes the shaders into one C++ file as string literals.
# cmake -DOUTPUT=embedded_shaders.cpp -DFOLDER=shaders -P embed_shaders.cmake
file(GLOB files ${FOLDER}/*.glsl ${FOLDER}/*.vert ${FOLDER}/*.frag)
list(SORT files)
set(text "#include \"planet/gl/device/shader_source.h\"\n\nnamespace planet::gl {\n\n")
string(APPEND text "std::string_view embeddedShader(std::string_view name) {\n")
foreach(file IN LISTS files)
  file(READ ${file} source)
  get_filename_component(name ${file} NAME)
  string(APPEND text "    if (name == \"${name}\") return R\"shader(${source})shader\";\n")
endforeach()
string(APPEND text "    return {};\n}\n\n}  // namespace planet::gl\n")
file(WRITE ${OUTPUT} "${text}")
