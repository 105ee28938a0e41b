#include "ui/shell/palette_items.h"

#include <algorithm>
#include <utility>

#include "app/base/text.h"
#include "app/settings/setting_value.h"
#include "app/settings/settings_schema.h"
#include "planet/sphere/chunk_id.h"
#include "ui/model/docking.h"
#include "ui/model/key_names.h"
#include "ui/model/typed_place.h"
#include "ui/panels/lod/chunk_heights.h"

namespace worldy::ui {

namespace {

void add(PaletteItems& items, PaletteEntry entry, PaletteChoice choice) {
    items.entries.push_back(std::move(entry));
    items.choices.push_back(std::move(choice));
}

void addChoices(PaletteItems& items, const Action& action, const ActionContext& context) {
    for (ActionChoice& choice : action.choices(context)) {
        add(items,
            {.kind = action.choiceKind,
             .title = std::move(choice.name),
             .detail = action.name,
             .help = action.help,
             .whyNot = std::move(choice.whyNot)},
            {.choose = [send = std::move(choice.send)](const ActionContext& c) { send(c.commands); }});
    }
}

void show(PanelId panel, const ActionContext& c) {
    showPanel(panel, c.workspace);
    c.menu.usedPanel = panel;
    c.menu.focusesPanel = true;
}

void addPanel(PaletteItems& items, const Action& action, std::string key) {
    add(items,
        {.kind = PaletteKind::Panel,
         .title = action.name,
         .key = std::move(key),
         .help = "Brings the panel to the front."},
        {.choose = [panel = *action.panel](const ActionContext& c) { show(panel, c); }});
}

void addActions(PaletteItems& items, const ActionContext& context) {
    for (std::size_t i = 0; i < actions().size(); ++i) {
        const Action& action = actions()[i];
        // These two actions would close the palette while the user chooses in it.
        if (action.id == "palette" || action.id == "close") continue;
        if (action.choices) {
            addChoices(items, action, context);
        } else if (action.panel) {
            addPanel(items, action, keysText(context.keys[i]));
        } else {
            const bool isOn = action.isOn && action.isOn(context);
            add(items,
                {.title = action.nameNow ? action.nameNow(context) : action.name,
                 .also = action.id,
                 .detail = isOn ? "on" : menuName(action.menu),
                 .key = keysText(context.keys[i]),
                 .help = action.help,
                 .whyNot = whyNot(action, context)},
                {.choose = action.act});
        }
    }
}

// Returns a setting's value as the panels show it.
std::string valueText(const Field& field) {
    if (const auto* const flag = std::get_if<Flag>(&field.value)) return *flag->value ? "on" : "off";
    if (const auto* const choice = std::get_if<Choice>(&field.value))
        return choiceLabel(*choice, *choice->value);
    const auto withUnit = [&](const NumberRange& range) {
        const std::string number = shortNumberText(plainText(field));
        return range.unit.empty() || range.unit == "°" ? number + std::string(range.unit)
                                                       : number + " " + std::string(range.unit);
    };
    if (const auto* const number = std::get_if<Number>(&field.value)) return withUnit(number->range);
    if (const auto* const integer = std::get_if<Integer>(&field.value)) return withUnit(integer->range);
    return plainText(field);
}

// Returns the panel that edits a setting which has no control.
std::optional<PanelId> editorOf(const Field& field) {
    if (std::holds_alternative<Ramp>(field.value) || std::holds_alternative<LayerStack>(field.value))
        return PanelId::Surface;
    if (std::holds_alternative<Text>(field.value))
        return field.table == "view" ? PanelId::Camera : PanelId::Surface;
    return std::nullopt;
}

void addSettings(PaletteItems& items, const ActionContext& context) {
    for (const Field& field : fieldsOf(context.settings)) {
        PaletteEntry entry{.kind = PaletteKind::Setting,
                           .title = std::string(titleOf(field)),
                           .also = field.name(),
                           .key = keyOf(field.name()),
                           .help = std::string(firstSentence(field))};
        if (const std::optional<PanelId> panel = editorOf(field)) {
            entry.detail =
                std::string("in the ") + panelInfos[static_cast<std::size_t>(*panel)].title + " panel";
            add(items, std::move(entry), {.choose = [id = *panel](const ActionContext& c) { show(id, c); }});
            continue;
        }
        entry.detail = valueText(field);
        add(items, std::move(entry), {.setting = field.name()});
    }
}

void addChunk(PaletteItems& items, std::string_view query, const ActionContext& context) {
    const std::optional<planet::ChunkId> id = planet::chunkIdFromString(query);
    if (!id) return;
    const planet::Planet* const planet = context.view.planet;
    add(items,
        {.kind = PaletteKind::Chunk,
         .title = planet::toString(*id),
         .detail = "Ctrl+Enter: look at it",
         .help =
             "Enter selects the chunk. Ctrl+Enter also moves the camera so that the whole chunk is visible.",
         .whyNot = planet ? chunkIdProblem(std::string(query), planet::deepestLevelOf(planet->tree().shape))
                          : "No planet is open.",
         .isTyped = true},
        {.choose = [id](const ActionContext& c) { c.commands.push_back(SelectChunk{id}); },
         .lookAt =
             [id](const ActionContext& c) {
                 c.commands.push_back(SelectChunk{id});
                 c.commands.push_back(LookAtChunk{*id});
             }});
}

// Returns the camera above a place, as high above the planet's radius as the camera is now, but at least so
// high that no mountain is higher.
planet::CameraPose poseAbove(const TypedPlace& place, const planet::CameraPose& now) {
    constexpr double leastM = 20'000;
    return {.latitudeDeg = place.latitudeDeg,
            .longitudeDeg = place.longitudeDeg,
            .altitudeM = std::max(now.altitudeM, leastM),
            .headingDeg = 0,
            .pitchDeg = -88};
}

void addPlace(PaletteItems& items, std::string_view query, const ActionContext& context) {
    const std::optional<TypedPlace> place = typedPlace(query);
    const std::string problem = typedPlaceProblem(query);
    if (!place && problem.empty()) return;
    add(items,
        {.kind = PaletteKind::Place,
         .title = place ? placeText(place->latitudeDeg, place->longitudeDeg) : std::string(query),
         .detail = "fly there",
         .help = "Moves the camera above the place, looking down. Latitude comes first, unless letters say "
                 "otherwise.",
         .whyNot = !context.view.planet ? "No planet is open." : problem,
         .isTyped = true},
        {.choose = [pose = poseAbove(place.value_or(TypedPlace{}), context.view.camera.pose)](
                       const ActionContext& c) {
            c.commands.push_back(MoveCamera{pose, true});
        }});
}

}  // namespace

PaletteItems paletteItems(std::string_view query, const ActionContext& context) {
    PaletteItems items;
    addChunk(items, query, context);
    addPlace(items, query, context);
    addActions(items, context);
    addSettings(items, context);
    return items;
}

}  // namespace worldy::ui
