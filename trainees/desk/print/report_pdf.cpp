// A report as PDF: the blocks, then head, foot and mark on every page, when their number is known.
#include "trainees/desk/print/page_flow.h"
#include "trainees/desk/print/report.h"

namespace trocar::printed {
namespace {

void put_title(PageFlow& flow, const Report& report) {
  flow.words(report.kind, plain(9), kDim);
  flow.words(report.title, bold(20), kInk);
  flow.down(2);
  flow.words(report.subtitle, plain(9.4), kDim);
  flow.down(8);
}

void put_blocks(PageFlow& flow, const std::vector<Block>& blocks) {
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    if (const auto* heading = std::get_if<Heading>(&blocks[i]))
      put(flow, *heading, i + 1 < blocks.size() ? least_height(flow, blocks[i + 1]) : 0);
    else
      std::visit(
          [&](const auto& block) {
            if constexpr (!std::is_same_v<std::decay_t<decltype(block)>, Heading>) put(flow, block);
          },
          blocks[i]);
  }
}

void put_frame(PdfPages& pages, const Report& report) {
  constexpr Font kFont = plain(7.6);
  constexpr double kHead = 40, kFoot = 812;
  const double left = PageFlow::kLeft, right = PageFlow::kRight;
  const Lines date = pages.lines(report.newest_utc.empty() ? "" : "Record to " + day_text(report.newest_utc), kFont);
  const Lines head =
      pages.lines("Trocar  |  " + report.kind + "  |  " + report.who, kFont, right - left - date.width() - 20, 1);
  const std::string foot =
      report.mark.empty()
          ? "Trocar is a training aid, not a medical device. A score judges a run at a simulator; a person signs."
          : report.mark + ": these trainees and attempts are invented. Nothing here is a record.";
  for (int i = 0; i < pages.count(); ++i) {
    pages.choose(i);
    if (!report.mark.empty()) pages.stamp(report.mark, kRed);
    pages.text(left, kHead, head, kDim);
    pages.text(right, kHead, date, kDim, Side::kRight);
    pages.line(left, kHead + 5, right, kHead + 5, 0.5, kRule);
    pages.line(left, kFoot - 11, right, kFoot - 11, 0.5, kRule);
    pages.text(left, kFoot, foot, kFont, report.mark.empty() ? kDim : kRed);
    pages.text(right, kFoot, std::to_string(i + 1) + " of " + std::to_string(pages.count()), kFont, kInk, Side::kRight);
  }
}

}  // namespace

std::string pdf_of(const Report& report) {
  PdfPages pages(report.kind + ": " + report.who, report.newest_utc);
  PageFlow flow(pages);
  put_title(flow, report);
  put_blocks(flow, report.blocks);
  put_frame(pages, report);
  return pages.bytes();
}

}  // namespace trocar::printed
