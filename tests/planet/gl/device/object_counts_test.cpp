#include "planet/gl/device/object_counts.h"

#include "planet/gl/device/gl_objects.h"
#include "tests/planet/gl/gl_test.h"

namespace planet::gl {
namespace {

class ObjectCounting : public GlTest {};

TEST_F(ObjectCounting, EachKindIsCountedWhileItLives) {
    const ObjectCounts before = countObjects();
    {
        const Buffer buffer = makeBuffer();
        glBindBuffer(GL_ARRAY_BUFFER, buffer.name());
        const Texture texture = makeTexture(), other = makeTexture();
        glBindTexture(GL_TEXTURE_2D, texture.name());
        glBindTexture(GL_TEXTURE_3D, other.name());
        const VertexArray array = makeVertexArray();
        glBindVertexArray(array.name());
        const Framebuffer framebuffer = makeFramebuffer();
        glBindFramebuffer(GL_FRAMEBUFFER, framebuffer.name());
        const Renderbuffer renderbuffer = makeRenderbuffer();
        glBindRenderbuffer(GL_RENDERBUFFER, renderbuffer.name());
        const Query query = makeQuery();
        glBeginQuery(GL_TIME_ELAPSED, query.name());
        glEndQuery(GL_TIME_ELAPSED);
        const Shader shader(glCreateShader(GL_VERTEX_SHADER));
        const Program program(glCreateProgram());
        ObjectCounts expected = before;
        ++expected.buffers;
        expected.textures += 2;
        ++expected.vertexArrays;
        ++expected.framebuffers;
        ++expected.renderbuffers;
        ++expected.queries;
        ++expected.shaders;
        ++expected.programs;
        EXPECT_EQ(countObjects(), expected);
        EXPECT_EQ(expected.total(), before.total() + 9);
    }
    EXPECT_EQ(countObjects(), before);
}

// Mesa never hands a name out again.
TEST_F(ObjectCounting, WhatComesAfterManyThatAreGoneIsSeen) {
    const ObjectCounts before = countObjects();
    for (int i = 0; i < 5000; ++i) {
        const Texture texture = makeTexture();
        glBindTexture(GL_TEXTURE_2D, texture.name());
        const Query query = makeQuery();
        glBeginQuery(GL_TIME_ELAPSED, query.name());
        glEndQuery(GL_TIME_ELAPSED);
        const Program program(glCreateProgram());
    }
    const Texture texture = makeTexture();
    glBindTexture(GL_TEXTURE_2D, texture.name());
    const Program program(glCreateProgram());
    const ObjectCounts now = countObjects();
    EXPECT_EQ(now.textures, before.textures + 1);
    EXPECT_EQ(now.programs, before.programs + 1);
    EXPECT_EQ(now.queries, before.queries);
}

TEST_F(ObjectCounting, ManyAreAllSeenThoughSomeBetweenAreGone) {
    const std::uint32_t before = countObjects().buffers;
    std::vector<Buffer> buffers;
    for (int i = 0; i < 1500; ++i) {
        buffers.push_back(makeBuffer());
        glBindBuffer(GL_ARRAY_BUFFER, buffers.back().name());
    }
    for (std::size_t i = 300; i < 700; ++i) buffers[i] = {};
    EXPECT_EQ(countObjects().buffers, before + 1100);
}

}  // namespace
}  // namespace planet::gl
