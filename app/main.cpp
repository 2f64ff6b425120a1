#include <cstdio>
#include <iostream>
#include "app/session.h"
#include "scenarios/exercise_loader.h"
using namespace trocar;
int main(int argc, char** argv) {
  try {
    AssetRoots assets = find_assets();
    AttemptSetup setup;
    setup.exercise = find_exercise("surface-touch", assets.exercises);
    setup.organ = argv[1];
    setup.hand = argv[2];
    setup.seed = argc > 3 ? atoi(argv[3]) : 1;
    setup.board = 1000 + setup.seed;
    Scene scene = build_scene(setup, assets, {"simulated", 1000, 16});
    printf("kappa %f\n", scene.loop.map.force_scale);
    MemorySink sink;
    RecordingWriter w(sink, scene_json(scene), 1000);
    auto out = run_session(scene, assets, w, [](const SessionView& v) {
      static int n = 0;
      if (n++ % 100 == 0) {
        auto& s = v.record.stylus;
        fprintf(stderr, "%.1f %s phase %d target %d done %d tip %.1f %.1f %.1f F %.2f ren %.2f jaw %.1f grip %.2f heat %.0f fault %s dropped\n", v.t_s, loop_state_name(s.loop), (int)v.director.status().phase, v.director.status().target_index, v.director.status().targets_done, s.X_TI.p[0] * 1e3, s.X_TI.p[1] * 1e3, s.X_TI.p[2] * 1e3, s.F_I_T.force.norm(), s.rendered_force_T.norm(), s.jaw_opening_m * 1e3, s.grip_force_n, v.record.winding_c, fault_name(s.fault.code));
      }
    });
    Recording r = parse_recording(sink.bytes(), "mem");
    Grade g = grade_recording(r, "mem");
    printf("status %s score %f passed %d bytes %zu ticks %zu hash %s dropped %lu\n", status_name(g.status), g.score.value_or(-1), g.passed, sink.bytes().size(), r.ticks.size(), out.state_hash_hex.c_str(), out.patch_triangles_dropped);
    for (auto& s : g.subscores) printf("  %s %.3f raw %g w %g\n", s.name.c_str(), s.value, s.raw.value_or(-1), s.weight);
    for (auto& s : g.caps) printf("  cap %s\n", s.c_str());
    for (auto& e : out.events) if (e.severity >= Severity::kMinor) printf("  %.2f %s %g\n", e.t_s, e.type.c_str(), e.value);
    auto rep = replay_session(scene, r);
    printf("replay hash %s\n", rep.state_hash_hex.c_str());
  } catch (const std::exception& e) { printf("%s\n", e.what()); return 2; }
}
