// Style sheet of the report page. Colours hold 4.5:1 on white; Okabe and Ito's hues; state is always also in words.
#pragma once

namespace trocar {

inline constexpr char kReportStyle[] = R"css(
:root{color-scheme:light}
*{box-sizing:border-box}
body{margin:0 auto;padding:20px 24px 28px;max-width:1120px;background:#fff;color:#14191f;font:16px/1.45 "DejaVu Sans","Segoe UI",Roboto,Arial,sans-serif}
h1{font-size:1.25rem;margin:0}
h2{font-size:1.02rem;margin:22px 0 6px;padding-bottom:3px;border-bottom:2px solid #d9dee4}
p{margin:4px 0}
.head{display:flex;justify-content:space-between;gap:18px;flex-wrap:wrap;align-items:baseline}
.dim{color:#4d5863}
.verdict{display:grid;grid-template-columns:auto 1fr auto;gap:8px 20px;align-items:center;margin:12px 0;padding:14px 18px;border:2px solid;border-left-width:12px;border-radius:6px}
.verdict .word{font-size:1.7rem;font-weight:700;white-space:nowrap}
.verdict .reason{font-size:1.08rem;font-weight:600;overflow-wrap:anywhere}
.verdict .score{font-size:2rem;font-weight:700;text-align:right;white-space:nowrap}
.verdict .score{line-height:1.15}.verdict .score small{font-size:.9rem;font-weight:400}
.pass{border-color:#00785a;background:#eef8f4}.pass .word{color:#006a4e}
.notyet{border-color:#b04a00;background:#fdf4ec}.notyet .word{color:#9c4100}
.notgraded{border-color:#5b6570;background:#f3f4f6}
.two{display:grid;grid-template-columns:minmax(0,1.55fr) minmax(0,1fr);gap:22px;align-items:start}
.two>*{min-width:0}
.two.path{grid-template-columns:minmax(0,1.35fr) minmax(0,1fr)}
img{width:100%;height:auto;display:block;border-radius:4px;background:#000}
svg{width:100%;height:auto;display:block;font-size:14px}
svg text{fill:#27313b}
table{border-collapse:collapse;width:100%;font-variant-numeric:tabular-nums}
th,td{text-align:left;padding:3px 8px 3px 0;vertical-align:top;overflow-wrap:anywhere}
th{font-weight:600;color:#4d5863;border-bottom:1px solid #c9ced4}
td.n,th.n{text-align:right;white-space:nowrap}
tr:nth-child(even) td{background:#f6f7f9}
.bar{display:block;width:100%;min-width:90px;height:14px;margin-top:5px;background:#dfe3e8;border-radius:3px;overflow:hidden}
.bar i{display:block;height:100%;background:#0072b2}
.bar i.low{background:#d55e00}
.tag{display:inline-block;padding:0 6px;border:1px solid #9c4100;border-radius:3px;color:#9c4100;font-size:.85rem;white-space:nowrap}
.tag.ok{border-color:#006a4e;color:#006a4e}
.facts td:first-child{color:#4d5863;width:38%}
.metrics{columns:2;column-gap:28px}
.metrics div{display:flex;justify-content:space-between;gap:10px;break-inside:avoid;border-bottom:1px solid #e6e9ed;padding:2px 0}
.metrics span:first-child{min-width:0;overflow-wrap:anywhere}
.metrics span:last-child{white-space:nowrap;font-weight:600}
.major td{font-weight:600}
.key{display:flex;flex-wrap:wrap;gap:4px 16px;font-size:.9rem}
.key b{display:inline-block;width:20px;margin-right:6px;vertical-align:middle}
.tag{margin-right:4px}
.mono{font-family:"DejaVu Sans Mono",Consolas,monospace;font-size:.82rem;overflow-wrap:anywhere}
footer{margin-top:20px;padding-top:8px;border-top:2px solid #d9dee4;font-size:.88rem;color:#3d4750}
@media screen and (max-width:760px){.two,.verdict{grid-template-columns:1fr}.metrics{columns:1}.verdict .score{text-align:left}}
@page{size:A4;margin:7mm 12mm}
@media print{html{font-size:10px}body{padding:0;max-width:none;font-size:10px;line-height:1.28}h2{margin:7px 0 2px;break-after:avoid}p{margin:1px 0}footer{margin-top:7px;padding-top:3px;font-size:8.5px}.tag{margin-right:4px}
.mono{font-size:7.6px}.two{grid-template-columns:minmax(0,1.9fr) minmax(0,1fr)}.two.top{grid-template-columns:minmax(0,1fr) minmax(0,1.15fr)}.force svg{width:70%;margin:0 auto}section,.verdict,tr,svg,img{break-inside:avoid}
.verdict{margin:4px 0;padding:5px 12px}.two{gap:14px}.metrics{columns:2;column-gap:14px}.two.path{grid-template-columns:minmax(0,1.3fr) minmax(0,1fr)}.path svg{width:56%;margin:0 auto}.path .facts td{font-size:9px}td,th{padding:1px 6px 1px 0}.bar{height:9px;margin-top:3px}
*{-webkit-print-color-adjust:exact;print-color-adjust:exact}}
)css";

}  // namespace trocar
