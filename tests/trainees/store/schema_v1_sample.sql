-- Three attempts as schema 1 stored them, hash chain included: what migrations of later schemas must carry over.
INSERT INTO trainee (id, uuid, code, created_utc) VALUES
(1, '01a1fca2-6c7f-755c-978b-386015516366', 'T-old', '2026-11-21T05:44:25.471Z'),
(2, '01a1fca2-6e52-760e-b232-6f45ff979865', 'T-cut', '2026-11-21T05:44:25.938Z');
INSERT INTO exercise_version (sha256, exercise_id, version, toml) VALUES
('f15c376e4a0751edfc6cb982422b3151188d3748b7772e77a2fa13f74d75bef4', 'surface-touch', '1', '# E02 Surface touch and force hold: twelve discs on an organ, each touched and held gently, then one measured squeeze.
# Units are in the keys. Every number is either sourced or a design choice [D] to be calibrated with people.
id = "surface-touch"
number = "E02"
version = "1"
title = "Surface touch"
goal = "Touch each lit disc, hold it with 0.4 to 0.8 N for one second, then squeeze the block gently."

time_limit_s = 3
hold_s = 1.0                  # continuous time in the band that completes a disc

[start]
radius_mm = 10                # the tip rests in this ball ...
hold_s = 1.0                  # ... for this long before the clock starts
above_mm = [0, 0, 45]         # its centre above the centre of the region [D]

[targets]
count = 12
diameter_mm = 6
region_mm = [100, 80]
relief_mm = 20                # discs lie within +- this height of the region''s centre
min_spacing_mm = 14           # [D]
max_slope_deg = 40            # between the surface and the horizontal [D]
wrong_place_mm = 2            # a contact that begins further outside the disc is a wrong place
retract_mm = 12               # the ideal path withdraws this far between discs [D]: surgeons pull back before they approach

[surface]
stiffness_n_per_m = 150       # published value for this device''s virtual wall
damping_s_per_m = 0.5         # Hunt-Crossley factor [D]

[force]
soft_n = 0.9                  # mean tool-tissue force of experts, suturing in a box: Horeman 2010, Surg Endosc 24:3102
hard_n = 1.5                  # EXCESS_FORCE above this [D]
critical_n = 4.7              # peak force of novices in the same study: CRITICAL_FORCE above this

[grip]
block_thickness_mm = 8
block_stiffness_n_per_m = 300 # [D]
low_n = 0.73                  # grips of experienced surgeons in three grasping tasks: 0.731, 1.203, 0.938 N
high_n = 1.20                 # (BMC Med Educ 2024, s12909-024-05155-1)
excess_n = 2.5                # GRIP_EXCESS above this: crush limit of the middle foam block of E03 [D]
hold_s = 1.0

[[levels]]
name = "L1"
mapping = "direct"
motion_scale = 1.0
force_scale = "auto"          # the largest factor <= 1 that the device can render (design of the instrument map)
band_n = [0.4, 0.8]
force_display = "always"

[rubric]
# muE, mean time of the expert hand over 20 boards in the kinematic closed loop of tests/scenarios (point mass of 0.4 kg
# behind 300 N/m). To be calibrated again on the whole device chain, and then with people.
expert_time_s = 37.5
pass_at = 75
proficient_at = 85
expert_at = 92
gate_cap = 59
critical_cap = 49
unfinished_cap = 49

[[rubric.subscores]]
name = "time"
metric = "time_s"
weight = 0.15
full_at_expert_times = 0.7    # full marks at 0.7 muE, none at 3 muE: anchors at the mean itself leave no headroom
zero_at_expert_times = 3.0

[[rubric.subscores]]
name = "place"
metric = "wrong_places"
weight = 0.20
full_at = 0
zero_at = 6

[[rubric.subscores]]
name = "force in band"
metric = "in_band_share"
weight = 0.35
full_at = 1.0
zero_at = 0.3
gate = true

[[rubric.subscores]]
name = "excess force"
metric = "excess_events"
weight = 0.20
full_at = 0
zero_at = 6
gate = true

[[rubric.subscores]]
name = "economy"
metric = "path_ratio"
weight = 0.10
full_at = 1.0
zero_at = 2.2
'),
('3cb5b8355fd995af1f68cde179b5fe1817a53362255953f52d0379bda303963f', 'surface-touch', '1', '# E02 Surface touch and force hold: twelve discs on an organ, each touched and held gently, then one measured squeeze.
# Units are in the keys. Every number is either sourced or a design choice [D] to be calibrated with people.
id = "surface-touch"
number = "E02"
version = "1"
title = "Surface touch"
goal = "Touch each lit disc, hold it with 0.4 to 0.8 N for one second, then squeeze the block gently."

time_limit_s = 3600
hold_s = 1.0                  # continuous time in the band that completes a disc

[start]
radius_mm = 10                # the tip rests in this ball ...
hold_s = 1.0                  # ... for this long before the clock starts
above_mm = [0, 0, 45]         # its centre above the centre of the region [D]

[targets]
count = 12
diameter_mm = 6
region_mm = [100, 80]
relief_mm = 20                # discs lie within +- this height of the region''s centre
min_spacing_mm = 14           # [D]
max_slope_deg = 40            # between the surface and the horizontal [D]
wrong_place_mm = 2            # a contact that begins further outside the disc is a wrong place
retract_mm = 12               # the ideal path withdraws this far between discs [D]: surgeons pull back before they approach

[surface]
stiffness_n_per_m = 150       # published value for this device''s virtual wall
damping_s_per_m = 0.5         # Hunt-Crossley factor [D]

[force]
soft_n = 0.9                  # mean tool-tissue force of experts, suturing in a box: Horeman 2010, Surg Endosc 24:3102
hard_n = 1.5                  # EXCESS_FORCE above this [D]
critical_n = 4.7              # peak force of novices in the same study: CRITICAL_FORCE above this

[grip]
block_thickness_mm = 8
block_stiffness_n_per_m = 300 # [D]
low_n = 0.73                  # grips of experienced surgeons in three grasping tasks: 0.731, 1.203, 0.938 N
high_n = 1.20                 # (BMC Med Educ 2024, s12909-024-05155-1)
excess_n = 2.5                # GRIP_EXCESS above this: crush limit of the middle foam block of E03 [D]
hold_s = 1.0

[[levels]]
name = "L1"
mapping = "direct"
motion_scale = 1.0
force_scale = "auto"          # the largest factor <= 1 that the device can render (design of the instrument map)
band_n = [0.4, 0.8]
force_display = "always"

[rubric]
# muE, mean time of the expert hand over 20 boards in the kinematic closed loop of tests/scenarios (point mass of 0.4 kg
# behind 300 N/m). To be calibrated again on the whole device chain, and then with people.
expert_time_s = 37.5
pass_at = 75
proficient_at = 85
expert_at = 92
gate_cap = 59
critical_cap = 49
unfinished_cap = 49

[[rubric.subscores]]
name = "time"
metric = "time_s"
weight = 0.15
full_at_expert_times = 0.7    # full marks at 0.7 muE, none at 3 muE: anchors at the mean itself leave no headroom
zero_at_expert_times = 3.0

[[rubric.subscores]]
name = "place"
metric = "wrong_places"
weight = 0.20
full_at = 0
zero_at = 6

[[rubric.subscores]]
name = "force in band"
metric = "in_band_share"
weight = 0.35
full_at = 1.0
zero_at = 0.3
gate = true

[[rubric.subscores]]
name = "excess force"
metric = "excess_events"
weight = 0.20
full_at = 0
zero_at = 6
gate = true

[[rubric.subscores]]
name = "economy"
metric = "path_ratio"
weight = 0.10
full_at = 1.0
zero_at = 2.2
');
INSERT INTO attempt (id, uuid, trainee_id, exercise_id, exercise_version, rubric_sha256, level, seed, board, hand, organ_name, organ_source, organ_sha256, organ_synthetic, organ_credit, started_utc, owner_pid, owner_boot, owner_start, status, finished_utc, score, passed, grade, recording_path, recording_sha256, state_hash, device_backend, device_rate_hz, device_ticks, device_overruns, saturated_contact_share, passivity_active_share, min_energy_j, kappa, device_fault, chain_position, prev_hash, row_hash) VALUES
(1, '01a1fca2-6c7f-7299-82dc-b1542bf849a8', 1, 'surface-touch', '1', 'f15c376e4a0751edfc6cb982422b3151188d3748b7772e77a2fa13f74d75bef4', 'L1', 1, 1001, 'dip.toml', 'liver', 'labels.nii.gz', '20bc223661e74c93639630d91483ed26f6356bdf3bd2326debf62b8632e943de', 1, 'synthetic CT phantom made by Trocar', '2026-11-21T05:44:25.471Z', 25534, 'dd448381-c48a-4d98-b942-2ddf62a32410', 1318747, 'timeout', '2026-11-21T05:44:25.645Z', 0.0, 0, 'below pass', 'a.trec', 'a3a74095440533a0ea821c0dfe23e70eed3ec153932d085c716f7b2490506440', 'eb7ea40a489b6a55', 'simulated', 1000.0, 3491, 0, 0.0, 0.0, -1.2332671137586837e-08, 1.0, '', 1, '', '20db9a2ad82229f0cd3a99932113cd3dcc951df119163e6acb3be5f701abb094'),
(2, '01a1fca2-6d64-7004-a8c3-a397f5c44989', 1, 'surface-touch', '1', 'f15c376e4a0751edfc6cb982422b3151188d3748b7772e77a2fa13f74d75bef4', 'L1', 2, 1002, 'expert', 'liver', 'labels.nii.gz', '20bc223661e74c93639630d91483ed26f6356bdf3bd2326debf62b8632e943de', 1, 'synthetic CT phantom made by Trocar', '2026-11-21T05:44:25.700Z', 25535, 'dd448381-c48a-4d98-b942-2ddf62a32410', 1318772, 'timeout', '2026-11-21T05:44:25.892Z', 0.0, 0, 'below pass', 'b.trec', '2abdf053742cfb7592471bd9b71cb0de7e295e6cf5df8a5a23bc3183a5e75cb0', '0af922301b2987b4', 'simulated', 1000.0, 3491, 0, 0.0, 0.0, -2.6410239060351545e-07, 1.0, '', 2, '20db9a2ad82229f0cd3a99932113cd3dcc951df119163e6acb3be5f701abb094', '1fa69eaed19bcf3bf51137e2a83103e70f51cd7de82c08e20b2c63766258cd85'),
(3, '01a1fca2-6e52-73e0-ab59-3f16e0d239e0', 2, 'surface-touch', '1', '3cb5b8355fd995af1f68cde179b5fe1817a53362255953f52d0379bda303963f', 'L1', 1, 1001, 'idle', 'liver', 'labels.nii.gz', '20bc223661e74c93639630d91483ed26f6356bdf3bd2326debf62b8632e943de', 1, 'synthetic CT phantom made by Trocar', '2026-11-21T05:44:25.938Z', 25538, 'dd448381-c48a-4d98-b942-2ddf62a32410', 1318797, 'aborted', '2026-11-21T05:44:27.852Z', NULL, 0, 'not graded', 'c.trec', '4d261b4fcf24d1a52ff7923eed6980cc6885e40cde7b8840cb7bed3b77c2fca9', '', '', NULL, 0, 0, NULL, NULL, NULL, NULL, '', 3, '1fa69eaed19bcf3bf51137e2a83103e70f51cd7de82c08e20b2c63766258cd85', '777c4ba4cfb3906ada68ed97d592e6ec10cfe3d4b9b014a0ec941a12fdc12ea3');
INSERT INTO event (attempt_id, position, t_s, type, severity, object, value, unit, tip_x_m, tip_y_m, tip_z_m) VALUES
(1, 0, 3.491, 'TIMEOUT', 'major', -1, 3.0, 's', 0.00509058890910809, -0.05339520250218133, -0.05697334440862531),
(2, 0, 3.491, 'TIMEOUT', 'major', -1, 3.0, 's', 0.00015905330146830874, 0.0009894751409889532, 0.044618941468275275);
INSERT INTO metric (attempt_id, position, name, value, unit) VALUES
(1, 9, 'angular_path_deg', NULL, 'deg'),
(1, 21, 'contact_time_s', NULL, 's'),
(1, 42, 'critical_events', 0.0, '1'),
(1, 8, 'depth_path_m', NULL, 'm'),
(1, 6, 'economy', NULL, '1'),
(1, 41, 'excess_events', 0.0, '1'),
(1, 22, 'force_max_n', NULL, 'N'),
(1, 23, 'force_mean_n', NULL, 'N'),
(1, 30, 'force_rate_max_n_per_s', NULL, 'N/s'),
(1, 24, 'force_rms_n', NULL, 'N'),
(1, 25, 'force_sd_n', NULL, 'N'),
(1, 28, 'force_volume_n3', NULL, 'N^3'),
(1, 34, 'grip_in_band_share', NULL, '1'),
(1, 32, 'grip_max_n', NULL, 'N'),
(1, 33, 'grip_mean_n', NULL, 'N'),
(1, 5, 'ideal_path_m', NULL, 'm'),
(1, 14, 'idle_share', NULL, '1'),
(1, 27, 'impulse_max_ns', NULL, 'N s'),
(1, 26, 'impulse_ns', NULL, 'N s'),
(1, 31, 'in_band_share', NULL, '1'),
(1, 17, 'ldlj', NULL, '1'),
(1, 15, 'movements', NULL, '1'),
(1, 18, 'normalised_jerk', NULL, '1'),
(1, 39, 'objects_done_share', 0.0, '1'),
(1, 37, 'passivity_active_share', NULL, '1'),
(1, 1, 'path_m', NULL, 'm'),
(1, 7, 'path_ratio', NULL, '1'),
(1, 2, 'path_x_m', NULL, 'm'),
(1, 3, 'path_y_m', NULL, 'm'),
(1, 4, 'path_z_m', NULL, 'm'),
(1, 35, 'regrasps', NULL, '1'),
(1, 36, 'saturated_contact_share', NULL, '1'),
(1, 29, 'soft_force_share', NULL, '1'),
(1, 16, 'sparc', NULL, '1'),
(1, 11, 'speed_max_mps', NULL, 'm/s'),
(1, 10, 'speed_mean_mps', NULL, 'm/s'),
(1, 13, 'speed_peak_rate_hz', NULL, '1/s'),
(1, 12, 'speed_peaks', NULL, '1'),
(1, 38, 'targets_held', 0.0, '1'),
(1, 0, 'time_s', NULL, 's'),
(1, 43, 'tool_collisions', 0.0, '1'),
(1, 19, 'tremor_rms_m', NULL, 'm'),
(1, 20, 'tremor_share', NULL, '1'),
(1, 40, 'wrong_places', 0.0, '1'),
(2, 9, 'angular_path_deg', NULL, 'deg'),
(2, 21, 'contact_time_s', NULL, 's'),
(2, 42, 'critical_events', 0.0, '1'),
(2, 8, 'depth_path_m', NULL, 'm'),
(2, 6, 'economy', NULL, '1'),
(2, 41, 'excess_events', 0.0, '1'),
(2, 22, 'force_max_n', NULL, 'N'),
(2, 23, 'force_mean_n', NULL, 'N'),
(2, 30, 'force_rate_max_n_per_s', NULL, 'N/s'),
(2, 24, 'force_rms_n', NULL, 'N'),
(2, 25, 'force_sd_n', NULL, 'N'),
(2, 28, 'force_volume_n3', NULL, 'N^3'),
(2, 34, 'grip_in_band_share', NULL, '1'),
(2, 32, 'grip_max_n', NULL, 'N'),
(2, 33, 'grip_mean_n', NULL, 'N'),
(2, 5, 'ideal_path_m', NULL, 'm'),
(2, 14, 'idle_share', NULL, '1'),
(2, 27, 'impulse_max_ns', NULL, 'N s'),
(2, 26, 'impulse_ns', NULL, 'N s'),
(2, 31, 'in_band_share', NULL, '1'),
(2, 17, 'ldlj', NULL, '1'),
(2, 15, 'movements', NULL, '1'),
(2, 18, 'normalised_jerk', NULL, '1'),
(2, 39, 'objects_done_share', 0.0, '1'),
(2, 37, 'passivity_active_share', NULL, '1'),
(2, 1, 'path_m', NULL, 'm'),
(2, 7, 'path_ratio', NULL, '1'),
(2, 2, 'path_x_m', NULL, 'm'),
(2, 3, 'path_y_m', NULL, 'm'),
(2, 4, 'path_z_m', NULL, 'm'),
(2, 35, 'regrasps', NULL, '1'),
(2, 36, 'saturated_contact_share', NULL, '1'),
(2, 29, 'soft_force_share', NULL, '1'),
(2, 16, 'sparc', NULL, '1'),
(2, 11, 'speed_max_mps', NULL, 'm/s'),
(2, 10, 'speed_mean_mps', NULL, 'm/s'),
(2, 13, 'speed_peak_rate_hz', NULL, '1/s'),
(2, 12, 'speed_peaks', NULL, '1'),
(2, 38, 'targets_held', 0.0, '1'),
(2, 0, 'time_s', NULL, 's'),
(2, 43, 'tool_collisions', 0.0, '1'),
(2, 19, 'tremor_rms_m', NULL, 'm'),
(2, 20, 'tremor_share', NULL, '1'),
(2, 40, 'wrong_places', 0.0, '1');
INSERT INTO subscore (attempt_id, position, name, value, weight, raw, unit, full_at, zero_at, gate) VALUES
(1, 4, 'economy', 0.0, 0.1, NULL, '1', 1.0, 2.2, 0),
(1, 3, 'excess force', 1.0, 0.2, 0.0, '1', 0.0, 6.0, 1),
(1, 2, 'force in band', 0.0, 0.35, NULL, '1', 1.0, 0.3, 1),
(1, 1, 'place', 1.0, 0.2, 0.0, '1', 0.0, 6.0, 0),
(1, 0, 'time', 0.0, 0.15, NULL, 's', 26.25, 112.5, 0),
(2, 4, 'economy', 0.0, 0.1, NULL, '1', 1.0, 2.2, 0),
(2, 3, 'excess force', 1.0, 0.2, 0.0, '1', 0.0, 6.0, 1),
(2, 2, 'force in band', 0.0, 0.35, NULL, '1', 1.0, 0.3, 1),
(2, 1, 'place', 1.0, 0.2, 0.0, '1', 0.0, 6.0, 0),
(2, 0, 'time', 0.0, 0.15, NULL, 's', 26.25, 112.5, 0);
INSERT INTO score_cap (attempt_id, position, reason) VALUES
(1, 0, 'safety: force in band below 0.5: at most 59'),
(1, 1, 'not finished: 0 of 13: at most 0'),
(2, 0, 'safety: force in band below 0.5: at most 59'),
(2, 1, 'not finished: 0 of 13: at most 0');
