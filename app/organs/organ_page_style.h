// Style sheet of the page of an organ. Colours hold 4.5:1 on white; Okabe and Ito's hues; state is always also in
// words.
#pragma once

namespace trocar {

inline constexpr char kOrganPageStyle[] = R"css(
:root{color-scheme:light}
*{box-sizing:border-box}
body{margin:0 auto;padding:20px 24px 28px;max-width:1120px;background:#fff;color:#14191f;font:16px/1.45 "DejaVu Sans","Segoe UI",Roboto,Arial,sans-serif}
h1{font-size:1.25rem;margin:0}
h2{font-size:1.02rem;margin:22px 0 6px;padding-bottom:3px;border-bottom:2px solid #d9dee4}
p{margin:4px 0}
.head{display:flex;justify-content:space-between;gap:18px;flex-wrap:wrap;align-items:baseline}
.dim{color:#4d5863}
img{width:100%;height:auto;display:block;border-radius:4px;background:#000}
svg{width:100%;height:auto;display:block;font-size:14px}
svg text{fill:#27313b}
table{border-collapse:collapse;width:100%;font-variant-numeric:tabular-nums}
th,td{text-align:left;padding:3px 8px 3px 0;vertical-align:top;overflow-wrap:anywhere}
th{font-weight:600;color:#4d5863;border-bottom:1px solid #c9ced4}
td.n,th.n{text-align:right;white-space:nowrap}
tr:nth-child(even) td{background:#f6f7f9}
.tag{display:inline-block;padding:0 6px;border:1px solid #9c4100;border-radius:3px;color:#9c4100;font-size:.85rem;white-space:nowrap}
.facts td:first-child{color:#4d5863;width:38%}
.key{display:flex;flex-wrap:wrap;gap:4px 16px;font-size:.9rem}
.key b{display:inline-block;width:20px;margin-right:6px;vertical-align:middle}
.tag{margin-right:4px}
.mono{font-family:"DejaVu Sans Mono",Consolas,monospace;font-size:.82rem;overflow-wrap:anywhere}
footer{margin-top:20px;padding-top:8px;border-top:2px solid #d9dee4;font-size:.88rem;color:#3d4750}
@page{size:A4;margin:7mm 12mm}
@media print{html{font-size:10px}body{padding:0;max-width:none;font-size:10px;line-height:1.28}h2{margin:7px 0 2px;break-after:avoid}p{margin:1px 0}footer{margin-top:7px;padding-top:3px;font-size:8.5px}
.mono{font-size:7.6px}tr,svg,img{break-inside:avoid}td,th{padding:1px 6px 1px 0}
*{-webkit-print-color-adjust:exact;print-color-adjust:exact}}
)css";

}  // namespace trocar
