#include "app/base/utf8.h"

#include <nlohmann/json.hpp>

namespace worldy {

bool isUtf8(std::string_view text) {
    try {
        nlohmann::json(text).dump();  // throws on text that is not UTF-8
        return true;
    } catch (const nlohmann::json::exception&) {
        return false;
    }
}

}  // namespace worldy
