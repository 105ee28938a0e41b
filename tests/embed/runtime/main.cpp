// Uses the runtime alone, without OpenGL: pages a planet in for one view and prints what a renderer would draw.
// Usage: runtime FILE.chk [LATITUDE LONGITUDE ALTITUDE_M]
#include <planet/planet.h>

#include <cstdio>
#include <cstdlib>

int main(int argc, char** argv) {
    if (argc != 2 && argc != 5)
        return std::fprintf(stderr, "usage: runtime FILE.chk [LATITUDE LONGITUDE ALTITUDE_M]\n"), 2;

    auto planet = planet::Planet::open(argv[1], planet::PagingSettings{});
    if (!planet) return std::fprintf(stderr, "%s\n", planet.error().message.c_str()), 2;

    planet::CameraPose camera{.latitudeDeg = 28, .longitudeDeg = 87, .altitudeM = 5e5};
    if (argc == 5)
        camera = {.latitudeDeg = std::atof(argv[2]),
                  .longitudeDeg = std::atof(argv[3]),
                  .altitudeM = std::atof(argv[4])};
    const double fovRad = 1.0;
    const planet::View view =
        planet::viewFromPose(camera, (*planet)->tree().shape.radiusM, fovRad, 1280, 720);
    if (!(*planet)->settle(view, planet::LodSettings{}, planet::noUpload, 60))
        return std::fprintf(stderr, "%s: not loaded after 60 s\n", argv[1]), 1;

    const planet::Selection& selection = (*planet)->selection();
    for (const planet::DrawItem& item : selection.draw)
        std::printf("%-16s error %.3f px, %.0f km away, slot %u\n", planet::toString(item.id).c_str(),
                    item.epsPx, item.distanceM / 1000, item.slot);
    std::printf("%zu chunks, %zu resident\n", selection.draw.size(),
                (*planet)->paging()[planet::BlockKind::Heights].resident);
}
