// The text in front of every chunk, sky and clipmap shader: the constants that GLSL and C++ share.
#pragma once

#include <string>

#include "planet/gl/draw/shader_switches.h"

namespace planet::gl {

// Declares each switch as a constant bool, and the C++ constants that shaders need, under their own names.
std::string shaderPrologue(Switches on);

}  // namespace planet::gl
