#include "trainees/desk/print/html_file.h"

#include "trainees/markup/html.h"

namespace trocar::printed {
namespace {

/// Colours and sizes of the printed page. A browser asks nothing of anybody: the policy in the head forbids it.
constexpr const char* kStyle = R"css(
*{box-sizing:border-box}
html{-webkit-text-size-adjust:100%}
body{margin:0 auto;padding:24px 28px 40px;max-width:1040px;background:#fff;color:#14191f;
  font:15px/1.45 "DejaVu Sans","Segoe UI",Roboto,Arial,sans-serif;
  font-variant-numeric:tabular-nums;overflow-wrap:break-word}
h1{font-size:1.9rem;line-height:1.2;margin:.1em 0 .1em}
h2{font-size:1.25rem;color:#00568a;border-bottom:2px solid #00568a;padding-bottom:3px;margin:1.8em 0 .6em}
h3{font-size:1.02rem;margin:1.2em 0 .3em}
p{margin:.3em 0}
.quiet,figcaption,caption,dt{color:#4a555f;font-size:.86rem}
.bad{color:#9c4100}.good{color:#00593f}
.point{padding-left:1em;text-indent:-1em}.point::before{content:"\25AA\00A0"}
.ribbon{background:#fde9df;color:#7a3000;border:1px solid #d55e00;padding:6px 10px;border-radius:5px}
.facts{display:grid;grid-template-columns:repeat(auto-fill,minmax(150px,1fr));gap:8px 14px;margin:.5em 0}
.facts[data-columns="2"]{grid-template-columns:repeat(auto-fill,minmax(320px,1fr))}
.facts[data-columns="1"]{grid-template-columns:minmax(0,1fr)}
.facts div{break-inside:avoid}
dd{margin:0;font-weight:700}
.mono,.mono dd{font:.78rem/1.4 "DejaVu Sans Mono",Consolas,monospace;font-weight:400}
table{border-collapse:collapse;width:100%;margin:.5em 0 1em;font-size:.86rem}
caption{text-align:left;padding-bottom:4px}
th{text-align:left;vertical-align:bottom;border-bottom:1.5px solid #14191f;padding:3px 8px 3px 0}
td{vertical-align:top;white-space:pre-line;overflow-wrap:anywhere;border-bottom:1px solid #d9dee4;padding:4px 8px 4px 0}
.n{text-align:right;white-space:nowrap;overflow-wrap:normal}
th.n{white-space:normal}
thead{display:table-header-group}
tr,figure,.verdict,.sheet{break-inside:avoid}
h2,h3{break-after:avoid}
.page{break-before:page}
.figures{display:flex;gap:14px;flex-wrap:nowrap;align-items:flex-start}
figure{margin:.5em 0}
svg{display:block;width:100%;height:auto;font-size:14px;overflow:visible}
svg text:not([fill]){fill:#27313b}
.square{font-size:20px}
.spark{width:90px;height:26px}
img{max-width:100%;display:block}
.verdict{display:grid;grid-template-columns:auto 1fr auto;gap:18px;align-items:center;background:#f3f6f8;
  border-left:7px solid #4a555f;padding:10px 16px;margin:.8em 0}
.verdict.good{border-color:#006b4f;color:inherit}.verdict.bad{border-color:#a84000;color:inherit}
.verdict .word,.verdict .number{font-size:1.6rem;font-weight:700}
.verdict.good .word{color:#006b4f}.verdict.bad .word{color:#a84000}
.verdict .number{text-align:right}.verdict small{display:block;font-size:.8rem;font-weight:400;color:#4a555f}
footer{margin-top:2.5em;border-top:1px solid #d9dee4;padding-top:6px;color:#4a555f;font-size:.8rem}
.sheet{border:3px double #00568a;padding:34px 40px;text-align:center;position:relative}
.sheet h1{font-weight:400;letter-spacing:.12em;text-transform:uppercase;color:#00568a;font-size:1.7rem}
.sheet .holder{font-size:1.9rem;font-weight:700;border-bottom:1px solid #808c97;display:inline-block;padding:0 24px 4px;margin:.5em 0 .2em}
.sheet .skill{font-size:1.2rem;font-weight:700}
.sheet table,.sheet dl,.sheet .not{text-align:left}
.sheet .signed{margin-top:1.6em}
.void{color:#a84000;font-weight:700;border:2px solid #a84000;padding:6px 10px;margin:0 0 14px}
@page{size:A4;margin:16mm}
@media print{body{max-width:none;padding:0;font-size:10pt}*{-webkit-print-color-adjust:exact;print-color-adjust:exact}}
)css";

}  // namespace

std::string html_begin(const std::string& title) {
  return "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"/>"
         "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src 'unsafe-inline'; "
         "img-src data:\"/>"
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/><title>" +
         escape_html(title) + "</title><style>" + kStyle + "</style></head><body>\n";
}

std::string column_widths(const std::vector<Column>& columns) {
  double all = 0;
  for (const Column& column : columns) all += column.share;
  std::string out = "<colgroup>";
  for (const Column& column : columns) out += "<col style=\"width:" + fixed_text(100 * column.share / all, 2) + "%\"/>";
  return out + "</colgroup>";
}

std::string html_end() { return "</body></html>\n"; }

}  // namespace trocar::printed
