#include "ui/model/typed_place.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "app/base/text.h"

namespace worldy::ui {

namespace {

constexpr std::string_view degreeSign = "°";

// A number with the letter that follows or precedes it; '\0': none.
struct Angle {
    double degrees = 0;
    char letter = '\0';

    bool isLatitude() const { return letter == 'N' || letter == 'S'; }
    bool isLongitude() const { return letter == 'E' || letter == 'W'; }
    double signedDegrees() const { return letter == 'S' || letter == 'W' ? -degrees : degrees; }
};

char upper(char c) {
    return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
}

bool isCompassLetter(char c) {
    return upper(c) == 'N' || upper(c) == 'S' || upper(c) == 'E' || upper(c) == 'W';
}

class Scanner {
public:
    explicit Scanner(std::string_view text) : text_(text) {}

    std::optional<std::array<Angle, 2>> angles() {
        const std::optional<Angle> first = angle();
        if (!first) return std::nullopt;
        skip(" \t");
        if (!text_.empty() && (text_[0] == ',' || text_[0] == ';')) text_.remove_prefix(1);
        const std::optional<Angle> second = angle();
        skip(" \t");
        if (!second || !text_.empty()) return std::nullopt;
        return std::array{*first, *second};
    }

private:
    void skip(std::string_view letters) {
        while (!text_.empty() && letters.find(text_[0]) != std::string_view::npos) text_.remove_prefix(1);
    }

    char takeLetter() {
        if (text_.empty() || !isCompassLetter(text_[0])) return '\0';
        const char letter = upper(text_[0]);
        text_.remove_prefix(1);
        return letter;
    }

    std::optional<Angle> angle() {
        skip(" \t");
        Angle angle;
        angle.letter = takeLetter();
        skip(" \t");
        const std::size_t end = std::min(text_.find_first_not_of("+-.0123456789"), text_.size());
        std::string_view digits = text_.substr(0, end);
        text_.remove_prefix(end);
        if (digits.starts_with('+')) digits.remove_prefix(1);
        const std::optional<double> number = numberFromText(digits);
        if (!number) return std::nullopt;
        angle.degrees = *number;
        skip(" \t");
        if (text_.starts_with(degreeSign)) text_.remove_prefix(degreeSign.size());
        skip(" \t");
        // The letter of the next angle may precede its number.
        const bool isOfNext = text_.size() > 1 && isCompassLetter(text_[0]) &&
                              std::string_view("+-.0123456789").find(text_[1]) != std::string_view::npos;
        if (angle.letter == '\0' && !isOfNext) angle.letter = takeLetter();
        if (angle.letter != '\0' && angle.degrees < 0) return std::nullopt;
        return angle;
    }

    std::string_view text_;
};

// Returns latitude and longitude, whatever their range.
std::optional<TypedPlace> anglesIn(std::string_view text) {
    auto angles = Scanner(text).angles();
    if (!angles) return std::nullopt;
    auto& [latitude, longitude] = *angles;
    if (latitude.isLongitude() || longitude.isLatitude()) std::swap(latitude, longitude);
    if (latitude.isLongitude() || longitude.isLatitude()) return std::nullopt;
    return TypedPlace{latitude.signedDegrees(), longitude.signedDegrees()};
}

}  // namespace

std::optional<TypedPlace> typedPlace(std::string_view text) {
    const std::optional<TypedPlace> place = anglesIn(text);
    if (!place || std::abs(place->latitudeDeg) > 90 || std::abs(place->longitudeDeg) > 360)
        return std::nullopt;
    return TypedPlace{place->latitudeDeg, std::remainder(place->longitudeDeg, 360)};
}

std::string typedPlaceProblem(std::string_view text) {
    const std::optional<TypedPlace> place = anglesIn(text);
    if (!place) return "";
    if (std::abs(place->latitudeDeg) > 90)
        return fmt::format("latitude {:.6g} is out of range [-90, 90]°", place->latitudeDeg);
    if (std::abs(place->longitudeDeg) > 360)
        return fmt::format("longitude {:.6g} is out of range [-360, 360]°", place->longitudeDeg);
    return "";
}

}  // namespace worldy::ui
