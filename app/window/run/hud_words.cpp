#include "app/window/run/hud_words.h"

#include "app/window/kinds/kind_lesson.h"

namespace trocar {
namespace {

void put(std::string& text, const Translator& in) {
  if (!text.empty()) text = in.made(text);
}

void put_labels(HudLabels& labels, const Translator& in) {
  for (std::string* text : {&labels.match, &labels.force, &labels.steps, &labels.so_far, &labels.device, &labels.tip,
                            &labels.angle, &labels.error, &labels.limit, &labels.peak, &labels.band, &labels.more})
    *text = in(*text);
  labels.decimal = in.decimal_sign();
}

}  // namespace

Hud in_words(Hud hud, const Translator& in) {
  put_labels(hud.labels, in);
  put(hud.trainee, in);
  put(hud.title, in);
  for (ForceBar& bar : hud.bars) put(bar.label, in), put(bar.hidden_note, in);
  if (hud.dial) put(hud.dial->hidden_note, in);
  for (HudNotice& notice : hud.notices) put(notice.text, in);
  for (HudStep& step : hud.steps) put(step.text, in);
  for (std::vector<HudRow>* rows : {&hud.rows, &hud.device})
    for (HudRow& row : *rows) put(row.name, in), put(row.value, in);
  put(hud.toast, in);
  put(hud.toast_hint, in);
  put(hud.credit, in);
  return hud;
}

const std::vector<std::string>& hud_sentences() {
  static const std::vector<std::string> kSentences = [] {
    std::vector<std::string> all{
        // display
        words("Guest"), words("Trainee: {0}"), words("{0} · {1} · {2}"), words("Rest at the start"), words("Hold"),
        words("Grip force"), words("shown after the run"), words("shown only outside the limits"),
        words("Over the band: {0} N"), words("Under the band: {0} N"), words("Held near the port: draw back"),
        words("Clutch: the instrument stands still"), words("Pedal down"), words("Probe"), words("Grasper"),
        words("Instrument"), words("Pedal"), words("down"), words("up"), words("Cuts"), words("Tears"),
        words("Clips set"), words("Blood lost"), words("Bleeding now"), words("Sucked off"), words("Tissue"),
        words("Bleeding: {0} mL/min"), words("Not cut: no tissue between the blades"),
        words("Not cut: the blades only touch the surface"), words("Not cut: cut to shreds here already"),
        words("Not cut: the cut would go through the organ"), words("Not cut: the cut would take a piece off"),
        words("Not cut: too close to a cut, begin at its end"), words("No clip set: no wound between the jaws"),
        words("The clip applier is empty."), words("There is no duct between the jaws."),
        words("Something else is between the jaws too."), words("The clip must lie straight across the duct."),
        words("A part of the duct lies outside the jaws."), words("The tips of the clip do not show beyond the duct."),
        words("The jaws were not closed fully."), words("The blades stand on a clip."), words("A clip was pulled off."),
        words("Scissors"), words("Hook"), words("Clip applier"), words("Suction"), words("Needle driver"),
        words("Punctures"), words("Stitches"), words("Throws"), words("Knot"), words("half knot"), words("square knot"),
        words("surgeon's knot"), words("granny knot"), words("slip knot"), words("Pull on the needle"), words("plant"),
        words("simulated"), words("loop"), words("passivity"), words("acting"), words("ok"), words("force scale"),
        words("motor heat"), words("depth in port"),
        words("No organ, no patient data · board exercise in a box trainer"), words("Organ: {0}"),
        words("Organ: {0} (synthetic)"), words("Organ: {0} · {1}"), words("Organ: {0} (synthetic) · {1}"),
        // director, and what kinds share
        words("Waiting for the device"), words("It starts when homing is complete."), words("The device is homed"),
        words("Take the stylus and close the deadman."), words("Move each joint slowly"),
        words("Until its mark has been seen; then into the jig."), words("Put the stylus into its jig"),
        words("Turn it until the light of the jig is on."), words("Turn the stylus in its jig"),
        words("Slowly through the light, once from either side."), words("Leave the stylus in its jig"),
        words("Nothing may move for half a second."), words("It was moved. Leave it alone."),
        words("No light: turn the stylus, look at the light's wires."),
        words("Always light: shade the receiver, look at its wires."),
        words("It sits wrong in the jig: put it in once more."), words("A joint does not count: look at its encoder."),
        words("Not homed for long: begin anew, or call for help."), words("Hold still in the start ball"),
        words("The clock starts in a moment."), words("Move the tip into the start ball"),
        words("It floats above the organ."), words("It floats above the board."), words("Done"),
        words("Your result follows."), words("Time is up"), words("Not begun"),
        words("The tip did not rest in the start ball. Nothing is graded."), words("Device switched off"),
        words("A graded attempt cannot be paused: it is void."), words("Device fault"),
        words("This attempt is not graded."), words("Good - hold"), words("A little softer"), words("{0} to {1} N"),
        words("{0} of {1}")};
    for (const KindLesson& lesson : all_lessons())
      for (const char* sentence : lesson.display) all.emplace_back(sentence);
    return all;
  }();
  return kSentences;
}

}  // namespace trocar
