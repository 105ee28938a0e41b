// The data set that the window shows: on its way to a chunk file, or open.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "app/bake_job.h"
#include "app/data_set.h"
#include "app/log.h"
#include "app/picture.h"
#include "app/scene.h"

namespace worldy {

// Either bakes, or is open, or has a problem.
struct Session {
    DataSet data;
    planet::BakeSettings bakeSettings;
    std::filesystem::path shaderFolder;  // empty: the shaders built in
    std::filesystem::file_time_type shadersChanged{};
    std::optional<Picture> colour;
    std::unique_ptr<BakeJob> bake;
    std::optional<Scene> scene;
    std::optional<planet::Error> problem;  // why there is nothing to show
};

Session startSession(DataSet data, const std::filesystem::path& shaderFolder, const Log& log);

void startBake(Session& session, const Log& log);

// Opens what has been baked; passes the open planet's problems to the log.
void advanceSession(Session& session, const ui::ViewSettings& settings, const Log& log);

// Opens the planet anew, for a budget or a number of threads that has changed.
void reopenScene(Session& session, const ui::ViewSettings& settings, const Log& log);

// Compiles the shaders of the folder again once one of them has changed.
void reloadChangedShaders(Session& session, const Log& log);

}  // namespace worldy
