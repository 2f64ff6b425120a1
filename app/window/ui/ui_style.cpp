#include "app/window/ui/ui_style.h"

#include <filesystem>

#include <imgui.h>

#include "haptics/input_error.h"

namespace trocar {
namespace {

/// px at 720 lines: nothing is smaller than 18.
constexpr double kBodyPx = 18, kHeadingPx = 20, kTitlePx = 32;

std::string font_file(const char* file) {
  std::string searched;
  for (const char* place : {"/usr/share/fonts/truetype/dejavu", "/usr/share/fonts/dejavu", "/usr/share/fonts/TTF",
                            "/usr/share/fonts/dejavu-sans-fonts", "/usr/local/share/fonts"}) {
    std::error_code ignored;
    const std::filesystem::path path = std::filesystem::path(place) / file;
    if (std::filesystem::exists(path, ignored)) return path.string();
    searched += std::string(" ") + place;
  }
  throw EnvironmentError(std::string("font ") + file + " not found in" + searched + "; install fonts-dejavu-core");
}

/// Latin with the letters of central Europe, and the signs that sentences use: dashes, quotes, dots, arrows, minus,
/// infinity, checks.
const ImWchar* glyph_ranges() {
  static const ImWchar kRanges[] = {0x0020, 0x017F, 0x0394, 0x0394, 0x03B1, 0x03C9, 0x2010, 0x2026, 0x2030,
                                    0x2030, 0x2039, 0x203A, 0x20AC, 0x20AC, 0x2190, 0x2193, 0x2212, 0x2212,
                                    0x221E, 0x221E, 0x2248, 0x2248, 0x2264, 0x2265, 0};
  return kRanges;
}

}  // namespace

ImVec4 vec(Rgb c, double opacity) {
  return {static_cast<float>(c.r) / 255, static_cast<float>(c.g) / 255, static_cast<float>(c.b) / 255,
          static_cast<float>(opacity)};
}

unsigned packed(Rgb colour, double opacity) { return ImGui::ColorConvertFloat4ToU32(vec(colour, opacity)); }

std::array<ImFont*, 3> load_fonts(double unit) {
  ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
  atlas.Clear();
  atlas.Flags |= ImFontAtlasFlags_NoMouseCursors;
  ImFontConfig config;
  config.OversampleH = unit < 1.5 ? 2 : 1;
  config.OversampleV = 1;
  const auto add = [&](const char* file, double px) {
    ImFont* font =
        atlas.AddFontFromFileTTF(font_file(file).c_str(), static_cast<float>(px * unit), &config, glyph_ranges());
    if (font == nullptr)
      throw EnvironmentError(font_file(file) + ": cannot be read as a font; reinstall fonts-dejavu-core");
    return font;
  };
  std::array<ImFont*, 3> fonts{add("DejaVuSans.ttf", kBodyPx), add("DejaVuSans-Bold.ttf", kHeadingPx),
                               add("DejaVuSans-Bold.ttf", kTitlePx)};
  if (!atlas.Build()) throw EnvironmentError("the fonts of the window cannot be prepared: too little memory");
  return fonts;
}

void apply_style(double unit) {
  ImGuiStyle style;
  style.WindowPadding = ImVec2(18, 16);
  style.WindowRounding = 10;
  style.WindowBorderSize = 0;
  style.WindowMinSize = ImVec2(8, 8);
  style.FramePadding = ImVec2(12, 7);
  style.FrameRounding = 6;
  style.FrameBorderSize = 0;
  style.ItemSpacing = ImVec2(10, 7);
  style.ItemInnerSpacing = ImVec2(8, 6);
  style.ScrollbarSize = 12;
  style.GrabMinSize = 14;
  style.GrabRounding = 6;
  style.PopupRounding = 6;
  style.ScaleAllSizes(static_cast<float>(unit));
  const auto set = [&style](ImGuiCol which, Rgb colour, double opacity = 1) {
    style.Colors[which] = vec(colour, opacity);
  };
  set(ImGuiCol_Text, ink_colour(Ink::kText));
  set(ImGuiCol_TextDisabled, ink_colour(Ink::kDim));
  set(ImGuiCol_WindowBg, ground_colour(Ground::kPanel), kPanelOpacity);
  set(ImGuiCol_PopupBg, ground_colour(Ground::kPanel), 0.98);
  set(ImGuiCol_Border, shape_colour(Ink::kDim), 0.5);
  for (const ImGuiCol col : {ImGuiCol_FrameBg, ImGuiCol_ScrollbarBg}) set(col, ground_colour(Ground::kField));
  set(ImGuiCol_FrameBgHovered, ground_colour(Ground::kButton));
  set(ImGuiCol_FrameBgActive, ground_colour(Ground::kButton));
  set(ImGuiCol_ScrollbarGrab, shape_colour(Ink::kDim));
  set(ImGuiCol_SliderGrab, okabe_ito::kSky);
  set(ImGuiCol_SliderGrabActive, okabe_ito::kSky);
  set(ImGuiCol_CheckMark, okabe_ito::kSky);
  set(ImGuiCol_Button, ground_colour(Ground::kButton));
  set(ImGuiCol_ButtonHovered, ground_colour(Ground::kButtonHover));
  set(ImGuiCol_ButtonActive, ground_colour(Ground::kButtonHover));
  set(ImGuiCol_Header, ground_colour(Ground::kChosen));
  set(ImGuiCol_HeaderHovered, ground_colour(Ground::kButton));
  set(ImGuiCol_HeaderActive, ground_colour(Ground::kChosen));
  set(ImGuiCol_NavHighlight, okabe_ito::kYellow);
  set(ImGuiCol_TextSelectedBg, ground_colour(Ground::kStrong));
  ImGui::GetStyle() = style;
}

}  // namespace trocar
