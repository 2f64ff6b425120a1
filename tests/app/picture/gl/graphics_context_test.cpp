#include <thread>

#include "haptics/input_error.h"
#include "tests/support/headless_fixture.h"
#include "tests/support/procedural_scene.h"

namespace trocar::graphics_context_test {
namespace {

using ContextTest = testing_support::HeadlessFixture;

TEST_F(ContextTest, SaysWhatItDrawsWith) {
  EXPECT_FALSE(context_->info().platform.empty());
  EXPECT_NE(context_->info().renderer, "unknown");
  EXPECT_GE(context_->info().version[0], '3');
}

TEST_F(ContextTest, SecondContextWorksBesideTheFirst) {
  HeadlessContext other;
  EXPECT_EQ(other.info().renderer, context_->info().renderer);
  context_->make_current();
  other.make_current();
  context_->make_current();
}

TEST_F(ContextTest, RefusesToBeCurrentOnTwoThreads) {
  context_->make_current();
  bool refused = false;
  std::thread other([&] {
    try {
      context_->make_current();
    } catch (const EnvironmentError& error) {
      refused = std::string(error.what()).find("thread") != std::string::npos;
    }
  });
  other.join();
  EXPECT_TRUE(refused);
}

TEST_F(ContextTest, MissingShadersNameTheFile) {
  Renderer renderer(*context_, "/nonexistent-assets");
  try {
    renderer.render(testing_support::procedural_scene(), 640, 360);
    FAIL() << "rendering without shaders must fail";
  } catch (const EnvironmentError& error) {
    EXPECT_NE(std::string(error.what()).find("/nonexistent-assets/shaders/"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace trocar::graphics_context_test
