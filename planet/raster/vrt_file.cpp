#include "planet/raster/vrt_file.h"

#include <cpl_conv.h>
#include <cpl_minixml.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <map>
#include <memory>
#include <span>
#include <string_view>
#include <system_error>
#include <utility>

#include "planet/base/try.h"
#include "planet/raster/gdal_formats.h"

namespace planet {

namespace {

constexpr std::uintmax_t mostVrtBytes = 16u << 20;
constexpr std::size_t mostSources = 1u << 20;
constexpr int mostXmlLevels = 32;

struct XmlDestroyer {
    void operator()(CPLXMLNode* node) const { CPLDestroyXMLNode(node); }
};
using Xml = std::unique_ptr<CPLXMLNode, XmlDestroyer>;

// Lists the attributes and children that an element may have.
struct VrtElement {
    std::string_view name;
    std::span<const std::string_view> attributes;
    std::span<const std::string_view> children;
};

constexpr std::array<std::string_view, 2> dataSetAttributes = {"rasterXSize", "rasterYSize"};
constexpr std::array<std::string_view, 8> dataSetChildren = {"SRS",           "GeoTransform", "Metadata",
                                                             "VRTRasterBand", "MaskBand",     "BlockXSize",
                                                             "BlockYSize",    "OverviewList"};
constexpr std::array<std::string_view, 4> bandAttributes = {"dataType", "band", "blockXSize", "blockYSize"};
constexpr std::array<std::string_view, 14> bandChildren = {
    "NoDataValue",  "HideNoDataValue", "ColorInterp", "Description", "UnitType",
    "Offset",       "Scale",           "Metadata",    "Histograms",  "CategoryNames",
    "SimpleSource", "ComplexSource",   "NodataValue", "MaskBand"};
constexpr std::array<std::string_view, 1> sourceAttributes = {"resampling"};
constexpr std::array<std::string_view, 15> sourceChildren = {
    "SourceFilename", "SourceBand",  "SourceProperties", "SrcRect",     "DstRect",
    "NODATA",         "ScaleOffset", "ScaleRatio",       "UseMaskBand", "LUT",
    "Exponent",       "SrcMin",      "SrcMax",           "DstMin",      "DstMax"};
constexpr std::array<std::string_view, 3> fileNameAttributes = {"relativeToVRT", "relativetoVRT", "shared"};
constexpr std::array<std::string_view, 1> maskChildren = {"VRTRasterBand"};

constexpr std::array<VrtElement, 6> vrtElements = {{{"VRTDataset", dataSetAttributes, dataSetChildren},
                                                    {"VRTRasterBand", bandAttributes, bandChildren},
                                                    {"MaskBand", {}, maskChildren},
                                                    {"SimpleSource", sourceAttributes, sourceChildren},
                                                    {"ComplexSource", sourceAttributes, sourceChildren},
                                                    {"SourceFilename", fileNameAttributes, {}}}};

bool isDeeperThan(const CPLXMLNode* node, int levels) {
    if (!node) return false;
    if (levels == 0) return true;
    for (const CPLXMLNode* child = node->psChild; child; child = child->psNext) {
        if (isDeeperThan(child, levels - 1)) return true;
    }
    return false;
}

bool mayHave(const VrtElement& element, const CPLXMLNode& child) {
    const auto& names = child.eType == CXT_Attribute ? element.attributes : element.children;
    return std::ranges::find(names, std::string_view(child.pszValue)) != names.end();
}

// Metadata of the file itself and of its structure. Other domains can name files.
bool isPlainMetadata(const CPLXMLNode& node) {
    const std::string_view domain = CPLGetXMLValue(&node, "domain", "");
    return domain.empty() || domain == "IMAGE_STRUCTURE";
}

class VrtCheck {
public:
    VrtCheck(std::string file, std::filesystem::path folder)
        : file_(std::move(file)), folder_(std::move(folder)) {}

    // Checks an element and those in it; makes the paths of sources absolute.
    Result<void> check(CPLXMLNode& node) {
        const auto element =
            std::ranges::find(vrtElements, std::string_view(node.pszValue), &VrtElement::name);
        if (element == vrtElements.end()) return {};  // holds no more than text
        for (CPLXMLNode* child = node.psChild; child; child = child->psNext) {
            if (child->eType == CXT_Text || child->eType == CXT_Comment) continue;
            const bool metadata = std::string_view(child->pszValue) == "Metadata";
            if (!mayHave(*element, *child) || (metadata && !isPlainMetadata(*child))) {
                return badInput(fmt::format(
                    "{}: has {} \"{}\" in {}; expected a plain mosaic of SimpleSource and ComplexSource, as "
                    "gdalbuildvrt writes it",
                    file_, child->eType == CXT_Attribute ? "an attribute" : "an element", child->pszValue,
                    element->name));
            }
            if (child->eType == CXT_Element) TRY(check(*child));
        }
        return element->name.ends_with("Source") ? checkSource(node) : Result<void>();
    }

    std::vector<std::filesystem::path> takeSources() const {
        std::vector<std::filesystem::path> sources;
        for (const auto& [source, opened] : names_) sources.push_back(source);
        return sources;
    }
    std::vector<std::shared_ptr<const NetcdfCopy>> takeCopies() { return std::move(copies_); }

private:
    Result<void> checkSource(CPLXMLNode& source) {
        if (++count_ > mostSources)
            return badInput(fmt::format("{}: has more than {} sources; expected fewer", file_, mostSources));
        int names = 0;
        for (const CPLXMLNode* child = source.psChild; child; child = child->psNext)
            names += std::string_view(child->pszValue) == "SourceFilename" ? 1 : 0;
        if (names != 1) {
            return badInput(
                fmt::format("{}: a source has {} elements SourceFilename; expected one", file_, names));
        }
        TRY_ASSIGN(const std::string opened, sourceNamed(CPLGetXMLValue(&source, "SourceFilename", "")));
        CPLXMLNode* const name = CPLGetXMLNode(&source, "SourceFilename");
        for (CPLXMLNode* child = name->psChild; child; child = child->psNext) {
            const bool isRelative =
                child->eType == CXT_Attribute && std::string_view(child->pszValue) != "shared";
            if (isRelative) CPLSetXMLValue(child, "", "0");
        }
        CPLSetXMLValue(&source, "SourceFilename", opened.c_str());
        return {};
    }

    // Returns the name that GDAL opens for a source.
    Result<std::string> sourceNamed(const std::string& name) {
        const auto refused = [&](std::string_view why) {
            return badInput(fmt::format("{}: its source \"{}\" {}; expected a raster file in {} or below it",
                                        file_, name, why, folder_.string()));
        };
        std::error_code problem;
        const std::filesystem::path found = std::filesystem::canonical(folder_ / name, problem);
        if (problem || !std::filesystem::is_regular_file(found, problem)) return refused("is no file");
        if (!found.string().starts_with((folder_ / "").string()))
            return refused("lies outside of the VRT's folder");
        if (const auto known = names_.find(found); known != names_.end()) return known->second;
        if (isVrtFile(found)) return refused("is a VRT");
        if (!isGdalRaster(found)) return refused("is no raster in one of the formats that are read");
        std::string opened = found.string();
        if (isNetcdf(found)) {
            TRY_ASSIGN(auto copy, copyOfNetcdf(found));
            opened = copy->name;
            copies_.push_back(std::move(copy));
        }
        return names_.emplace(found, std::move(opened)).first->second;
    }

    std::string file_;
    std::filesystem::path folder_;
    std::map<std::filesystem::path, std::string> names_;  // of the sources, and what GDAL opens for each
    std::vector<std::shared_ptr<const NetcdfCopy>> copies_;
    std::size_t count_ = 0;
};

Result<std::string> textOf(const std::filesystem::path& path) {
    std::error_code problem;
    const std::uintmax_t bytes = std::filesystem::file_size(path, problem);
    if (problem) return ioError(fmt::format("{}: {}", path.string(), problem.message()));
    if (bytes > mostVrtBytes) {
        return badInput(fmt::format("{}: is {} bytes large; expected at most {} for a VRT", path.string(),
                                    bytes, mostVrtBytes));
    }
    std::ifstream stream(path, std::ios::binary);
    std::string text(bytes, '\0');
    stream.read(text.data(), static_cast<std::streamsize>(bytes));
    text.resize(static_cast<std::size_t>(stream.gcount()));
    return text;
}

}  // namespace

Result<VrtFile> checkedVrt(const std::filesystem::path& path) {
    TRY_ASSIGN(const auto text, textOf(path));
    const QuietErrors quiet;
    const Xml xml(CPLParseXMLString(text.c_str()));
    CPLXMLNode* const root = xml ? CPLGetXMLNode(xml.get(), "=VRTDataset") : nullptr;
    if (!root || isDeeperThan(root, mostXmlLevels)) {
        return badInput(
            fmt::format("{}: is no valid XML with one element VRTDataset; expected a VRT as "
                        "gdalbuildvrt writes it",
                        path.string()));
    }
    std::error_code problem;
    const std::filesystem::path own = std::filesystem::canonical(path, problem);
    if (problem)
        return ioError(fmt::format("{}: its folder cannot be found: {}", path.string(), problem.message()));
    VrtCheck check(path.string(), own.parent_path());
    TRY(check.check(*root));
    VrtFile vrt;
    // Only this element is opened, not what follows it.
    CPLXMLNode* const rest = root->psNext;
    root->psNext = nullptr;
    char* const serialised = CPLSerializeXMLTree(root);
    root->psNext = rest;
    vrt.xml = serialised;
    CPLFree(serialised);
    vrt.sources = check.takeSources();
    vrt.copies = check.takeCopies();
    return vrt;
}

}  // namespace planet
