// `trocar study indentation | relaxation | grasp | cutting | suturing | multirate | solvers | tissue-scaling`: tissue
// that gives way beside converged numbers, published ranges, other ways between its rate and the loop's, other solvers,
// and its cost.
#pragma once

#include "app/studies/study.h"

namespace trocar {

/// Stiffness of a block under a load and under the probe, over cell sizes, and a nodule below the surface.
StudyResult indentation_study(const StudyRequest& request);
/// A step held: the probe's force over time beside the material's Prony series.
StudyResult relaxation_study(const StudyRequest& request);
/// A fold held by the jaws and pulled: what holds, what slips, what is left afterwards.
StudyResult grasp_study(const StudyRequest& request);
/// Cuts: how wounds open by tension at rest and cell size, what blades take, what a cut costs.
StudyResult cutting_study(const StudyRequest& request);
StudyResult suturing_study(const StudyRequest& request);
/// The same press by ours, the held force, a linear coupling and the thesis' law.
StudyResult multirate_study(const StudyRequest& request);
/// The same organ by ours, corotational linear tetrahedra and XPBD: error at equal time.
StudyResult solvers_study(const StudyRequest& request);
/// Time of a step over the number of nodes.
StudyResult tissue_scaling_study(const StudyRequest& request);

}  // namespace trocar
