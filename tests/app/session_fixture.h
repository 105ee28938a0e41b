// What tests of sessions and scenes share: a context without a window, a cache of their own, a small source.
#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <stdexcept>
#include <thread>

#include "app/session/session.h"
#include "planet/gl/device/offscreen_context.h"
#include "tests/support/temporary_folder.h"

namespace worldy::test {

class SessionTest : public testing::Test {
protected:
    SessionTest() {
        auto context = planet::gl::OffscreenContext::create();
        if (!context) throw std::runtime_error(context.error().message);
        context_ = std::make_unique<planet::gl::OffscreenContext>(std::move(*context));
        const char* cache = std::getenv("XDG_CACHE_HOME");
        if (cache) oldCache_ = cache;
        setenv("XDG_CACHE_HOME", folder_.path().c_str(), 1);
    }
    ~SessionTest() override {
        if (oldCache_.empty())
            unsetenv("XDG_CACHE_HOME");
        else
            setenv("XDG_CACHE_HOME", oldCache_.c_str(), 1);
    }

    std::filesystem::path writeSource(const std::string& name = "slope.pgm", int steepness = 1) const {
        const std::filesystem::path file = folder_ / name;
        std::ofstream stream(file, std::ios::binary);
        stream << "P5\n64 32\n255\n";
        for (int i = 0; i < 64 * 32; ++i)
            stream.put(static_cast<char>(steepness * (i % 64 < 32 ? i % 64 : 63 - i % 64)));
        return file;
    }

    std::filesystem::path bakeTo(const std::string& name, const planet::BakeSettings& settings) const {
        const auto source = planet::openHeightSource(writeSource(), {});
        if (!source || !planet::bake(*source, settings, folder_ / name)) throw std::runtime_error("no bake");
        return folder_ / name;
    }

    BakeRequest requestFor(const std::filesystem::path& source, int chunkSize, int faceSize = 65) const {
        BakeRequest request;
        request.source = source;
        request.settings.chunkSize = chunkSize;
        request.settings.faceSize = faceSize;
        return request;
    }

    Session sessionOf(const std::filesystem::path& file, const planet::BakeSettings& settings = {}) {
        const auto data = findDataSet(file, settings);
        if (!data) throw std::runtime_error(data.error().message);
        return startSession(*data, {}, log_);
    }

    // Frames until something holds; false if it never does.
    bool advanceUntil(Session& session, const std::function<bool()>& holds) {
        const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(120);
        while (std::chrono::steady_clock::now() < end) {
            advanceSession(session, settings_, log_);
            if (holds()) return true;
            std::this_thread::sleep_for(std::chrono::milliseconds(2));
        }
        return false;
    }
    bool advanceUntilQuiet(Session& session) {
        return advanceUntil(session, [&] { return !session.bake && session.ending.empty(); });
    }

    std::size_t filesInCache() const {
        std::error_code status;
        std::size_t count = 0;
        for (const auto& entry : std::filesystem::directory_iterator(cacheFolderPath(), status)) {
            static_cast<void>(entry);
            ++count;
        }
        return count;
    }
    std::filesystem::path cacheFolderPath() const { return folder_ / "worldy"; }

    const tests::TemporaryFolder folder_;
    const Log log_;
    ViewSettings settings_;

private:
    std::unique_ptr<planet::gl::OffscreenContext> context_;
    std::string oldCache_;
};

}  // namespace worldy::test
