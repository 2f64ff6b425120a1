// Fixture for tests that draw: one context for all of them, skipped loudly where the machine has no EGL at all.
#pragma once

#include <gtest/gtest.h>

#include <dlfcn.h>

#include <memory>
#include <string>

#include "app/picture/gl/headless_context.h"
#include "app/picture/scene/renderer.h"

namespace trocar::testing_support {

class HeadlessFixture : public ::testing::Test {
 protected:
  void SetUp() override {
    void* egl = dlopen("libEGL.so.1", RTLD_LAZY | RTLD_LOCAL);
    if (!egl) GTEST_SKIP() << "NO PICTURE IS TESTED HERE: libEGL.so.1 is not installed";
    dlclose(egl);
    context_ = std::make_unique<HeadlessContext>();  // where EGL exists, failing to draw is a failure
  }

  Renderer make_renderer(RenderOptions options = {.text_scale = 1, .scene_scale = 1, .grain = false}) {
    return Renderer(*context_, std::string(TROCAR_SOURCE_DIR) + "/assets", options);
  }

  std::unique_ptr<HeadlessContext> context_;
};

}  // namespace trocar::testing_support
