// Reads TOML, as the library does.
#pragma once

#include "planet/source/toml_file.h"

namespace worldy {

using planet::NumberRange;
using planet::parseTomlFile;
using planet::parseTomlText;
using planet::placeOf;
using planet::readBool;
using planet::readInteger;
using planet::readNumber;
using planet::readText;
using planet::shownValue;
using planet::textOf;

}  // namespace worldy
