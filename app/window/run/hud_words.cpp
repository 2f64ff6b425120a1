#include "app/window/run/hud_words.h"

namespace trocar {
namespace {

/// Named so that the check of the catalogues finds them: the argument is a sentence a person sees.
std::string words(const char* sentence) { return sentence; }

void put(std::string& text, const Words& in) {
  if (!text.empty()) text = in.made(text);
}

void put_labels(HudLabels& labels, const Words& in) {
  for (std::string* text : {&labels.match, &labels.force, &labels.steps, &labels.so_far, &labels.device, &labels.tip,
                            &labels.angle, &labels.error, &labels.limit, &labels.peak, &labels.band, &labels.more})
    *text = in(*text);
  labels.decimal = in.decimal_sign();
}

}  // namespace

Hud in_words(Hud hud, const Words& in) {
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
  static const std::vector<std::string> kSentences{
      // display
      words("Guest"), words("Trainee: {0}"), words("{0} · {1} · {2}"), words("Rest at the start"),
      words("Match each lit pen and hold"), words("Touch and hold each disc"), words("Squeeze the block"),
      words("Carry each lit block to its ring"), words("Hold"), words("Pens matched"), words("Out of time"),
      words("Discs held"), words("Wrong places"), words("Too much force"), words("Blocks placed"), words("Errors"),
      words("Tip force"), words("Grip force"), words("shown after the run"), words("shown only outside the limits"),
      words("Over the band: {0} N"), words("Under the band: {0} N"), words("Held near the port: draw back"),
      words("Clutch: the instrument stands still"), words("plant"), words("simulated"), words("loop"),
      words("passivity"), words("acting"), words("ok"), words("force scale"), words("motor heat"),
      words("depth in port"), words("No organ, no patient data · board exercise in a box trainer"), words("Organ: {0}"),
      words("Organ: {0} (synthetic)"), words("Organ: {0} · {1}"), words("Organ: {0} (synthetic) · {1}"),
      // director
      words("Waiting for the device"), words("It starts when homing is complete."),
      words("Hold still in the start ball"), words("The clock starts in a moment."),
      words("Move the tip into the start ball"), words("It floats above the organ."),
      words("It floats above the board."), words("Done"), words("Your result follows."), words("Time is up"),
      words("Device switched off"), words("A graded attempt cannot be paused: it is void."), words("Device fault"),
      words("This attempt is not graded."),
      // discs and block
      words("Too hard - ease off"), words("Stay between {0}."), words("Wrong place"),
      words("Lift off and touch inside the lit disc."), words("Touch the lit disc"), words("Disc {0}: {1}."),
      words("Move onto the lit disc"), words("The tip is beside it."), words("Hold by feel"), words("Wanted: {0}."),
      words("A little softer"), words("Press gently"), words("Reach {0} and hold."), words("Good - hold"),
      words("Keep the force steady."), words("Open the jaws"), words("A block will be placed between them."),
      words("Squeeze the block by feel"), words("Too tight - ease off"), words("Squeeze with {0}."),
      words("Keep the squeeze steady."),
      // pens
      words("Pen {0}."), words("Bring the tip to the lit pen"), words("Turn the instrument along the pen"),
      words("The tip is right."),
      // foam blocks
      words("Block {0}."), words("Hold it with {0}."), words("A little tighter"), words("Pick up the lit block"),
      words("Set it down within the ring"), words("Let go when it stands."), words("Carry it to its ring"),
      words("Lift it well clear of the others."), words("Crushed - hold it more gently"),
      words("It slips - hold it tighter"), words("Dropped - pick it up again"), words("Lift it higher on the way"),
      words("{0} to {1} N"), words("{0} of {1}")};
  return kSentences;
}

}  // namespace trocar
