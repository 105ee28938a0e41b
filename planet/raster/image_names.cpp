#include "planet/raster/image_names.h"

#include <algorithm>
#include <cctype>
#include <system_error>

namespace planet {

std::string lowerCase(std::string text) {
    std::ranges::transform(text, text.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

bool isRawImage(const std::filesystem::path& path) {
    const std::string extension = lowerCase(path.extension().string());
    return extension == ".raw" || extension == ".r16";
}

std::filesystem::path worldFileBeside(const std::filesystem::path& image) {
    const std::string extension = lowerCase(image.extension().string());
    if (extension.size() < 2) return {};
    for (std::string name :
         {std::string{'.', extension[1], extension.back(), 'w'}, extension + 'w', std::string(".wld")}) {
        for (int i = 0; i < 2; ++i) {
            std::filesystem::path file = image;
            file.replace_extension(name);
            std::error_code status;
            if (file != image && std::filesystem::is_regular_file(file, status)) return file;
            for (char& letter : name)
                letter = static_cast<char>(std::toupper(static_cast<unsigned char>(letter)));
        }
    }
    return {};
}

std::vector<std::filesystem::path> sidecarsOf(const std::filesystem::path& image) {
    std::vector<std::filesystem::path> files;
    if (const std::filesystem::path world = worldFileBeside(image); !world.empty()) files.push_back(world);
    std::error_code status;
    const std::filesystem::path auxiliary = image.string() + ".aux.xml";
    if (std::filesystem::is_regular_file(auxiliary, status)) files.push_back(auxiliary);
    return files;
}

}  // namespace planet
