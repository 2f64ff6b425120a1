// Style sheet of the desk. Text holds 4.5:1 on its ground, lines and shapes 3:1; hues of Okabe and Ito; state is always
// shape and word too.
#include "trainees/desk/pages/style.h"

namespace trocar::review {

namespace {
constexpr char kStyle[] = R"css(:root{color-scheme:light}
*{box-sizing:border-box}
html{-webkit-text-size-adjust:100%}
body{margin:0;background:#f2f4f6;color:#14191f;font:16px/1.45 "DejaVu Sans","Segoe UI",Roboto,Arial,sans-serif;font-variant-numeric:tabular-nums}
main{max-width:1400px;margin:0 auto;padding:14px 18px 30px}
a{color:#00568a}
a:hover{text-decoration-thickness:2px}
:focus-visible{outline:3px solid #b04a00;outline-offset:2px;border-radius:2px}
.top :focus-visible{outline-color:#ffd28a}
.skip{position:absolute;left:-999px;top:0;background:#fff;padding:8px 14px;z-index:9}
.skip:focus{left:8px}
.unseen{position:absolute;width:1px;height:1px;overflow:hidden;clip-path:inset(50%)}
.sprite{position:absolute}
.top{display:flex;flex-wrap:wrap;align-items:center;gap:6px 24px;padding:9px 18px;background:#1d2935;color:#fff}
.brand{font-weight:700}
.top nav{display:flex;flex-wrap:wrap;gap:4px 20px}
.top a{color:#d4e9f8}
.who{margin:0 0 0 auto;display:flex;gap:10px;align-items:center}
.who button{background:#33475a;color:#fff;border-color:#6d8296}
.ribbon{display:flex;flex-wrap:wrap;gap:4px 18px;align-items:center;justify-content:space-between;padding:6px 18px;background:#5d2a4c;color:#fff}
.ribbon p{margin:0}
.ribbon .button{background:#fff;color:#5d2a4c;border-color:#fff;padding:1px 10px;min-height:0}
.ribbon .button:hover{background:#f3e6ef}
.ribbon :focus-visible{outline-color:#ffd28a}
.paper{display:none}
.central{margin:12px 0;background:#fff3d6;border:1px solid #b07c00;border-left-width:6px;border-radius:6px;padding:8px 12px;color:#1d2630}
h1{font-size:1.5rem;margin:0;overflow-wrap:anywhere}
h2{font-size:1.08rem;margin:0 0 8px}
h3{font-size:1rem;margin:14px 0 4px}
p{margin:6px 0;overflow-wrap:anywhere}
small{font-size:.86rem}
.dim{color:#4a555f}
.title{display:flex;flex-wrap:wrap;gap:2px 18px;align-items:baseline;margin:2px 0 10px}
.title p{margin:0}
.files{margin-left:auto!important}
.files a{margin-left:12px}
.card,.plain main{background:#fff;border:1px solid #d5dbe1;border-radius:8px;padding:14px 16px;margin:0 0 14px;min-width:0}
.plain main{max-width:460px;margin:8vh auto}
.plain input{width:100%}
.quiet{color:#4a555f;font-size:.9rem}
.two{display:grid;grid-template-columns:minmax(0,1.25fr) minmax(0,1fr);gap:0 14px;align-items:start}
.two.even{grid-template-columns:minmax(0,1fr) minmax(0,1fr)}
.two.moment{grid-template-columns:minmax(0,1fr) minmax(0,1.55fr);gap:18px}
.two>div{min-width:0}
.states{display:grid;grid-template-columns:repeat(4,minmax(0,1fr));gap:14px;margin-bottom:14px}
.state{background:#fff;border:1px solid #d5dbe1;border-top:8px solid;border-radius:8px;padding:10px 14px;position:relative;min-width:0}
.state h2{font-size:1.02rem;padding-right:52px;margin:0}
.state .count{position:absolute;right:14px;top:2px;font-size:2rem;font-weight:700;margin:0;line-height:1.3}
.state ul{list-style:none;margin:8px 0 0;padding:0}
.state li{margin:0 0 7px;line-height:1.3;overflow-wrap:anywhere}
.state li a{font-weight:700}
.state small{color:#2b343c;text-wrap:pretty}
.state.unsafe{border-top-color:#d55e00}.state.unsafe .count,.state.unsafe h2{color:#973f00}
.state.relapsed{border-top-color:#cc79a7}.state.relapsed .count,.state.relapsed h2{color:#862d5e}
.state.stuck{border-top-color:#e69f00}.state.stuck .count,.state.stuck h2{color:#7a5200}
.state.ready{border-top-color:#009e73}.state.ready .count,.state.ready h2{color:#00593f}
.more{margin:4px 0 0;font-size:.9rem}
.shape{width:.85em;height:.85em;margin-right:.4em;vertical-align:-.06em;fill:currentColor}
.badge{display:inline-block;padding:1px 8px 1px 7px;border:1px solid;border-radius:4px;white-space:nowrap;font-size:.9rem;font-weight:600;margin:1px 0}
.badge.unsafe{background:#fdeade;border-color:#d55e00;color:#8a3900}
.badge.relapsed{background:#faeaf2;border-color:#b85f92;color:#80285a}
.badge.stuck{background:#fdf2d8;border-color:#b98000;color:#6e4a00}
.badge.plateau{background:#faf7d6;border-color:#96891c;color:#564e00}
.badge.integrity{background:#e7eaed;border-color:#14191f;color:#14191f}
.badge.retention-due{background:#e6f3fb;border-color:#3d93c4;color:#084d76}
.badge.ready{background:#e1f5ed;border-color:#009e73;color:#00563d}
.badge.learning{background:#f3f5f7;border-color:#8592a0;color:#37424c}
.tag{display:inline-block;padding:0 6px;border:1px solid #973f00;border-radius:3px;color:#8a3900;font-size:.82rem;white-space:nowrap;font-weight:400}
.filters,.fields{display:flex;flex-wrap:wrap;gap:4px 12px;align-items:flex-end;margin:0 0 10px}
.field{margin:4px 0;min-width:0}
.filters .field,.fields .field{flex:0 1 auto}
label{display:block;font-size:.88rem;color:#37424c}
input,select,textarea,button,.button{font:inherit;color:inherit;padding:5px 9px;border:1px solid #7d8894;border-radius:5px;background:#fff;max-width:100%;min-height:34px}
textarea{width:100%;display:block}
.card>form>.field input,.card>details>form>.field input{width:100%}
.code{font:14px/1.4 "DejaVu Sans Mono",Consolas,monospace;white-space:pre;overflow:auto}
button,.button{background:#00568a;border-color:#00568a;color:#fff;cursor:pointer;text-decoration:none;display:inline-block;line-height:1.35}
button:hover,.button:hover{background:#00456f}
button.danger{background:#fff;color:#8a3900;border-color:#8a3900}
button.small{padding:1px 8px;min-height:26px;font-size:.85rem;background:#fff;color:#00568a}
.inline{display:flex;flex-wrap:wrap;gap:4px 10px;align-items:flex-end}
details{margin:8px 0}
summary{cursor:pointer;color:#00568a}
.scroll{overflow-x:auto;max-width:100%}
table{border-collapse:collapse;width:100%}
caption{text-align:left;color:#4a555f;font-size:.88rem;padding:0 0 6px}
th,td{text-align:left;padding:5px 10px 5px 0;vertical-align:top;border-bottom:1px solid #e3e7eb}
thead th{font-size:.9rem;color:#37424c;border-bottom:2px solid #b9c2cb;vertical-align:bottom;white-space:nowrap}
tbody th{font-weight:600}
td.n,th.n{text-align:right;white-space:nowrap}
td:last-child,th:last-child{padding-right:2px}
tbody tr:hover{background:#f4f8fb}
.cohort{min-width:1010px}
.cohort td small{color:#37424c}
.cohort tbody th{min-width:124px}
.cohort tbody td:nth-child(2){min-width:230px}
.bad{font-weight:700;color:#8a3900}
.grave th,.grave td{font-weight:600;background:#fdf5ef}
.long{min-width:200px;overflow-wrap:anywhere}
.metrics .long{min-width:280px;max-width:80ch}
.mono{font-family:"DejaVu Sans Mono",Consolas,monospace;font-size:.82rem;overflow-wrap:anywhere}
.parts{display:flex;flex-wrap:wrap;gap:6px 18px;margin:0 0 12px}
.parts a[aria-current]{font-weight:700;color:#14191f;text-decoration:none;border-bottom:3px solid #00568a}
.written{max-height:18em;overflow:auto;white-space:pre-wrap;overflow-wrap:anywhere;background:#f4f6f8;border:1px solid #d5dbe1;border-radius:6px;padding:8px 12px;font:inherit}
code{font-family:"DejaVu Sans Mono",Consolas,monospace;font-size:.88em;background:#eef1f4;padding:1px 4px;border-radius:3px;overflow-wrap:anywhere}
[aria-invalid]{border-color:#b04a00;border-width:2px}
.buttons{display:flex;flex-wrap:wrap;gap:8px}
td form{margin:0 0 4px}
td details{margin:0}
.pages{display:flex;flex-wrap:wrap;gap:12px;margin-top:10px}
figure{margin:0 0 8px;min-width:0}
figcaption{font-size:.86rem;color:#4a555f;margin-top:4px}
.plot{overflow-x:auto}
.plot svg{min-width:500px;max-width:980px}
.plot svg.weeks{min-width:300px}
svg{display:block;width:100%;height:auto;font-size:14px}
svg text:not([fill]){fill:#27313b}
.square{font-size:20px}
.spark{width:120px;height:34px}
.bar{width:72px;min-width:72px;height:12px;margin-top:6px}
svg.shape{display:inline;width:.85em;height:.85em;font-size:inherit}
time{white-space:nowrap}
svg.swatch{display:inline-block;width:22px;height:12px;margin-right:5px;vertical-align:-1px}
.key{display:inline-block;margin-right:14px}
.keys{font-size:.88rem;color:#37424c}
.strips a:hover rect{fill:#0072b2;fill-opacity:.14}
.strips rect{cursor:pointer}
.squares{display:grid;grid-template-columns:repeat(6,minmax(0,1fr));gap:12px}
.squares.four{grid-template-columns:repeat(4,minmax(0,1fr))}
.scope{width:100%;height:auto;display:block;border-radius:6px;background:#000;color:#fff}
.empty{padding:26px 10px;text-align:center;color:#4a555f;background:#f4f6f8;border-radius:6px}
.scrub{display:flex;gap:10px;align-items:center;margin:4px 0}
.scrub input{flex:1;min-width:0;padding:0}
.scrub button[hidden]{display:none}
.steps{display:flex;flex-wrap:wrap;gap:6px}
.steps .button{background:#fff;color:#00568a}
.steps .button:hover{background:#e6f1f8}
output{font-weight:600}
.verdict{display:grid;grid-template-columns:auto minmax(0,1fr) auto;gap:4px 22px;align-items:center;background:#fff;border:2px solid;border-left-width:12px;border-radius:8px;padding:10px 18px;margin:0 0 14px}
.verdict .word{font-size:1.6rem;font-weight:700;white-space:nowrap}
.verdict .reason{font-weight:600}
.verdict .score{font-size:1.8rem;font-weight:700;text-align:right;line-height:1.15}
.verdict .score small{font-size:.85rem;font-weight:400}
.verdict .override{grid-column:1/-1;border-top:1px solid #d5dbe1;padding-top:8px}
.verdict.pass{border-color:#00785a;background:#f1faf6}.verdict.pass .word{color:#00593f}
.verdict.notyet{border-color:#b04a00;background:#fdf6f0}.verdict.notyet .word{color:#8a3900}
.verdict.none{border-color:#5b6570}
.facts{display:flex;flex-wrap:wrap;gap:8px 26px;margin:8px 0}
.facts dt{font-size:.82rem;color:#4a555f}
.facts dd{margin:0;font-weight:600;overflow-wrap:anywhere}
.facts dd.mono{font-weight:400}
.facts.wide{display:grid;grid-template-columns:repeat(auto-fit,minmax(min(100%,210px),1fr))}
.judgements,.notes,.members,.checks{list-style:none;padding:0;margin:6px 0}
.judgements li{margin:0 0 5px}
.checks li{margin:0 0 3px}
.notes li{border-left:4px solid #56b4e9;padding:1px 0 1px 12px;margin:10px 0}
.notes .said{white-space:pre-line;margin:0}
.notes .dim{margin:2px 0;font-size:.86rem}
.rate{border:0;border-top:1px solid #e3e7eb;padding:6px 0;margin:0;min-width:0}
.rate legend{font-weight:600;padding:0}
.rate label{display:inline-flex;align-items:center;gap:4px;min-height:34px;margin:0 14px 0 0;color:inherit}
.rate input{min-height:0}
.rate p{margin:0}
.members{display:flex;flex-wrap:wrap;gap:6px 18px}
.members li{display:flex;gap:8px;align-items:center}
.members form{margin:0}
.grid td{min-width:130px}
.gridcell{display:inline-block;padding:4px 7px;border:1px solid transparent;border-radius:6px;color:inherit;text-decoration:none}
.gridcell:hover{background:#eef5fa}
.gridcell[aria-current]{border-color:#00568a;background:#eef5fa}
.certificate{border-left:4px solid #009e73;padding:1px 0 1px 12px;margin:10px 0}
.certificate.withdrawn{border-left-color:#8592a0;color:#37424c}
.notice,.message{background:#e1f5ed;border:1px solid #009e73;border-radius:6px;padding:8px 12px}
.error{background:#fdeade;border:1px solid #b04a00;border-radius:6px;padding:8px 12px;white-space:pre-wrap}
.warning{margin:8px 0 14px;background:#fdf2d8;border:1px solid #b98000;border-radius:6px;padding:8px 12px}
.warning p{margin:0}
.side h2{display:flex;align-items:center;gap:4px}
.live{font-size:1.15rem}
.forcebar{max-width:640px;margin:10px 0}
.stations{display:grid;grid-template-columns:repeat(auto-fit,minmax(min(100%,540px),1fr));gap:0 14px;align-items:start}
.stations td.n,.stations th.n{width:5em}
#together{flex-wrap:wrap}
#together input{flex:1 1 200px;min-width:160px}
progress{width:100%;max-width:480px;height:22px;accent-color:#00568a}
footer{max-width:1400px;margin:0 auto;padding:0 18px 20px;color:#4a555f;font-size:.86rem}
@media (max-width:1180px){.squares{grid-template-columns:repeat(3,minmax(0,1fr))}}
@media (max-width:900px){.two,.two.even,.two.moment{grid-template-columns:minmax(0,1fr)}.states,.squares.four{grid-template-columns:repeat(2,minmax(0,1fr))}}
@media (max-width:560px){main{padding:10px 8px 24px}.card{padding:10px}.states{gap:8px}.states{grid-template-columns:minmax(0,1fr)}.squares,.squares.four{grid-template-columns:repeat(2,minmax(0,1fr))}.verdict{grid-template-columns:minmax(0,1fr) auto;padding:8px 12px}.verdict .reason{grid-column:1/-1;grid-row:2}.top{padding:8px 10px}.ribbon{padding:6px 10px}.files{margin-left:0!important}.files a{margin:0 12px 0 0}.filters .field,.fields .field{flex:1 1 44%}.filters select,.fields select,.fields input,.inline .field,.inline input{width:100%}
.scroll table{font-size:.92rem}.scroll caption{max-width:calc(100vw - 38px)}th,td{padding:5px 8px 5px 0}thead th{white-space:normal}.long,.metrics .long{min-width:170px}.metrics tbody th{overflow-wrap:anywhere;min-width:110px}td time{white-space:normal;display:inline-block;min-width:88px}.top nav{order:2;flex-basis:100%;gap:4px 11px;font-size:.94rem}.who{order:1}
.cohort,.cohort caption,.cohort thead,.cohort tbody{display:block;min-width:0;width:100%}.cohort thead tr{display:flex;flex-wrap:wrap;gap:0 12px;border-bottom:2px solid #b9c2cb}.cohort thead tr::before{content:"Sort by";color:#4a555f;padding:5px 0}.cohort thead th{border:0}.cohort thead th:nth-child(8){display:none}
.cohort tbody tr{display:grid;grid-template-columns:repeat(3,minmax(0,1fr));gap:2px 8px;padding:8px 0;border-bottom:1px solid #c4ccd4}.cohort tbody th,.cohort tbody td{border:0;padding:0;text-align:left;min-width:0}.cohort tbody th,.cohort tbody td:nth-child(2),.cohort tbody td[colspan]{grid-column:1/-1}.cohort tbody td:nth-child(3){grid-column:1/3}.cohort tbody td:nth-child(8){grid-column:1/3}.cohort tbody td:nth-child(11){grid-column:2/4}.cohort td time{min-width:0}
.cohort td:nth-child(n+5)::before{color:#4a555f;font-size:.86rem;font-weight:400}.cohort td:nth-child(5)::before{content:"tries "}.cohort td:nth-child(6)::before{content:"best "}.cohort td:nth-child(7)::before{content:"last "}.cohort td:nth-child(9)::before{content:"force, N "}.cohort td:nth-child(10)::before{content:"over "}}
@page{size:A4;margin:12mm}
@media print{html{font-size:11px}body{background:#fff;font-size:11px}.top,.ribbon a,.skip,nav,form,button,.button,summary,details:not([open]),.steps,.scrub,.files,.more{display:none!important}.paper{display:block;margin:0 0 6px;padding:0 0 3px;border-bottom:1px solid #888;font-size:10px;color:#333}.ribbon{background:#fff;color:#000;border:1px solid #000;padding:2px 6px;margin:0 0 6px}main,footer{max-width:none;padding:0}.card,.state,.verdict{break-inside:auto;border-color:#888;margin-bottom:8px;padding:6px 8px}.state,.verdict,.certificate,.notes li,.facts{break-inside:avoid}.scroll,.plot{overflow:visible}.plot svg,.plot svg.weeks,.cohort,.metrics .long,.long,.grid td,.cohort tbody td:nth-child(2),.cohort tbody th{min-width:0}tr,figure,img,svg{break-inside:avoid}h2,h3,caption{break-after:avoid}thead{display:table-header-group}thead th,td.n,th.n{white-space:normal}th,td{padding:2px 5px 2px 0}td.n{white-space:nowrap}.spark{width:80px;height:24px}a{color:inherit;text-decoration:none}.two{grid-template-columns:minmax(0,1fr)}.two.even,#curve .two{grid-template-columns:minmax(0,1fr) minmax(0,1fr)}.two.moment{grid-template-columns:minmax(0,1fr) minmax(0,1.3fr)}#compare,.two.moment p.dim{display:none!important}.states,.squares.four{grid-template-columns:repeat(4,minmax(0,1fr));gap:6px}.squares{grid-template-columns:repeat(3,minmax(0,1fr))}.state .count{font-size:1.6rem}.scope{max-height:70mm;width:auto;max-width:100%}footer{border-top:1px solid #888;padding-top:3px;margin-top:8px}*{-webkit-print-color-adjust:exact;print-color-adjust:exact}}
)css";
}  // namespace

const char* style_sheet() { return kStyle; }

}  // namespace trocar::review
