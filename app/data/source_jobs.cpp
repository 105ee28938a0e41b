#include "app/data/source_jobs.h"

#include <utility>

namespace worldy {

SourceJob::SourceJob(std::filesystem::path source, planet::HeightSourceSettings settings)
    : Job([source = std::move(source),
           settings = std::move(settings)](const std::stop_token& stop) -> planet::Result<SharedLayers> {
          planet::HeightSourceSettings tolerant = settings;
          tolerant.skipBroken = true;
          tolerant.stop = stop;
          return planet::openHeightSource(source, tolerant).map([](const planet::HeightSource& opened) {
              return opened.layers;
          });
      }) {}

PlacesJob::PlacesJob(SharedLayers layers, std::vector<planet::Geographic> places)
    : Job([layers = std::move(layers), places = std::move(places)](const std::stop_token& stop) {
          std::vector<PlaceAnswer> answers;
          for (const planet::Geographic& place : places) {
              if (stop.stop_requested()) break;
              planet::Result<std::vector<planet::SourceReading>> readings = layers->at(place);
              answers.push_back(readings ? PlaceAnswer{*std::move(readings)}
                                         : PlaceAnswer{{}, readings.error().message});
          }
          return answers;
      }) {}

LeafDepthsJob::LeafDepthsJob(planet::ChunkFile file)
    : Job([file = std::move(file)](const std::stop_token& stop) {
          return leafDepthsOf(file, [&] { return !stop.stop_requested(); });
      }) {}

}  // namespace worldy
