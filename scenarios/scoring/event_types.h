// The types of events; docs/scoring.md says when each happens and what its value is.
//
// Records hold the name: they may come from a program that knows more types than this one.
#pragma once

#include <string>
#include <string_view>

namespace trocar {

/// What is logged and asked for. A literal does not turn into one, so that a misspelled type does not compile.
struct EventType {
  std::string_view name;

  friend constexpr bool operator==(std::string_view recorded, EventType type) { return recorded == type.name; }
};

namespace event_type {

// The director
inline constexpr EventType kStart{"START"}, kDone{"DONE"}, kTimeout{"TIMEOUT"}, kDeadmanOpen{"DEADMAN_OPEN"},
    kDeviceFault{"DEVICE_FAULT"};
// Its safety watch
inline constexpr EventType kExcessForce{"EXCESS_FORCE"}, kCriticalForce{"CRITICAL_FORCE"},
    kToolCollision{"TOOL_COLLISION"}, kDeviceLimit{"DEVICE_LIMIT"}, kClutch{"CLUTCH"}, kPortHold{"PORT_HOLD"},
    kInstrumentFree{"INSTRUMENT_FREE"};
// Its watch on surgery, where tissue gives way
inline constexpr EventType kCut{"CUT"}, kTear{"TEAR"}, kClip{"CLIP"}, kRefused{"REFUSED"}, kBleeding{"BLEEDING"},
    kBurn{"BURN"}, kNeedle{"NEEDLE"}, kPuncture{"PUNCTURE"}, kStitch{"STITCH"}, kThrow{"THROW"};
// Every kind of exercise
inline constexpr EventType kTargetLit{"TARGET_LIT"}, kTargetHeld{"TARGET_HELD"};
// Touch
inline constexpr EventType kTargetTouched{"TARGET_TOUCHED"}, kWrongPlace{"WRONG_PLACE"}, kGripTouched{"GRIP_TOUCHED"},
    kGripExcess{"GRIP_EXCESS"}, kGripHeld{"GRIP_HELD"}, kGripOffered{"GRIP_OFFERED"};
// Reach
inline constexpr EventType kPositionError{"POSITION_ERROR"}, kAngleError{"ANGLE_ERROR"},
    kTargetTimeout{"TARGET_TIMEOUT"};
// Grasp
inline constexpr EventType kRegrasp{"REGRASP"}, kLifted{"LIFTED"}, kSetDown{"SET_DOWN"}, kSlip{"SLIP"}, kCrush{"CRUSH"},
    kDrop{"DROP"}, kPlaced{"PLACED"}, kMisplaced{"MISPLACED"}, kLost{"LOST"}, kGrasped{"GRASPED"},
    kWrongBlock{"WRONG_BLOCK"}, kRemoved{"REMOVED"};
// Camera
inline constexpr EventType kWallContact{"WALL_CONTACT"}, kHorizonLost{"HORIZON_LOST"}, kHorizonKept{"HORIZON_KEPT"},
    kViewJerks{"VIEW_JERKS"};
// Wire
inline constexpr EventType kWireTouched{"WIRE_TOUCHED"}, kRingOff{"RING_OFF"};
// Palpate
inline constexpr EventType kNoduleFound{"NODULE_FOUND"}, kFalseMark{"FALSE_MARK"}, kSearchEnded{"SEARCH_ENDED"},
    kPlacePressed{"PLACE_PRESSED"};
// Retract
inline constexpr EventType kTissueTaken{"TISSUE_TAKEN"}, kExposed{"EXPOSED"}, kCovered{"COVERED"}, kLetGo{"LET_GO"};
// Pegs
inline constexpr EventType kBump{"BUMP"};
// Find
inline constexpr EventType kAnswered{"ANSWERED"}, kWrongAnswer{"WRONG_ANSWER"};
// Clip
inline constexpr EventType kNamed{"NAMED"}, kClipSet{"CLIP_SET"}, kClipWasted{"CLIP_WASTED"},
    kWrongStructure{"WRONG_STRUCTURE"}, kDivided{"DIVIDED"}, kCutTooSoon{"CUT_TOO_SOON"};
// Gauze
inline constexpr EventType kSnip{"SNIP"}, kOffLine{"OFF_LINE"}, kPulledHard{"PULLED_HARD"}, kGauzeTorn{"GAUZE_TORN"};
// Needle
inline constexpr EventType kNeedleGripped{"NEEDLE_GRIPPED"}, kBiteBegun{"BITE_BEGUN"}, kBiteThrough{"BITE_THROUGH"},
    kBiteUndone{"BITE_UNDONE"}, kNeedleDrawn{"NEEDLE_DRAWN"}, kNeedleLost{"NEEDLE_LOST"};
// Dissect
inline constexpr EventType kStrandLifted{"STRAND_LIFTED"}, kStrandDivided{"STRAND_DIVIDED"},
    kCurrentUsed{"CURRENT_USED"}, kUnsafeCurrent{"UNSAFE_CURRENT"}, kSpurts{"SPURTS"}, kSealed{"SEALED"},
    kSealedLate{"SEALED_LATE"}, kPerforated{"PERFORATED"};
// Operation
inline constexpr EventType kStageBegun{"STAGE_BEGUN"};
// Persons: nobody grades these, and running the recording again does not make them
inline constexpr EventType kMarked{"MARKED"}, kMessage{"MESSAGE"};

/// All of them.
inline constexpr EventType kAll[] = {
    kStart,         kDone,         kTimeout,        kDeadmanOpen,   kDeviceFault,    kExcessForce,  kCriticalForce,
    kToolCollision, kDeviceLimit,  kClutch,         kPortHold,      kInstrumentFree, kCut,          kTear,
    kClip,          kRefused,      kBleeding,       kBurn,          kNeedle,         kPuncture,     kStitch,
    kThrow,         kTargetLit,    kTargetHeld,     kTargetTouched, kWrongPlace,     kGripTouched,  kGripExcess,
    kGripHeld,      kGripOffered,  kPositionError,  kAngleError,    kTargetTimeout,  kRegrasp,      kLifted,
    kSetDown,       kSlip,         kCrush,          kDrop,          kPlaced,         kMisplaced,    kLost,
    kGrasped,       kWrongBlock,   kRemoved,        kWallContact,   kHorizonLost,    kHorizonKept,  kViewJerks,
    kWireTouched,   kRingOff,      kNoduleFound,    kFalseMark,     kSearchEnded,    kPlacePressed, kTissueTaken,
    kExposed,       kCovered,      kLetGo,          kBump,          kAnswered,       kWrongAnswer,  kNamed,
    kClipSet,       kClipWasted,   kWrongStructure, kDivided,       kCutTooSoon,     kSnip,         kOffLine,
    kPulledHard,    kGauzeTorn,    kNeedleGripped,  kBiteBegun,     kBiteThrough,    kBiteUndone,   kNeedleDrawn,
    kNeedleLost,    kStrandLifted, kStrandDivided,  kCurrentUsed,   kUnsafeCurrent,  kSpurts,       kSealed,
    kSealedLate,    kPerforated,   kStageBegun,     kMarked,        kMessage};

}  // namespace event_type
}  // namespace trocar
