#include "paper_figures/make_figure.h"

#include <chrono>
#include <exception>

#include "pipeline/atomic_file.h"
#include "pipeline/error.h"

namespace edgewise::figures {
namespace {

namespace fs = std::filesystem;

MadeFigure madeOf(const Figure& figure, const FigureStamp& stamp, bool reused) {
    MadeFigure made{&figure, figure.name + "/" + stamp.page, ""};
    made.claims = stamp.claims, made.seconds = stamp.seconds, made.reused = reused;
    made.quick = stamp.source.quick;
    return made;
}

/// The stamp goes first and comes last: between the two the folder fits nothing.
void writeFiles(const fs::path& folder, const std::vector<FigureFile>& files, const FigureStamp& stamp) {
    if (const auto old = readStamp(folder)) {
        fs::remove(folder / kStampFile);
        for (const auto& [name, hash] : old->contents)
            if (!stamp.contents.contains(name)) fs::remove(folder / name);
    }
    for (const FigureFile& file : files) writeAtomically(folder / file.name, file.bytes);
    writeAtomically(folder / kStampFile, stampText(stamp));
}

}  // namespace

MadeFigure makeFigure(const Figure& figure, const FigureSource& source, const fs::path& folder,
                      Progress& progress) {
    if (const auto stamp = readStamp(folder); stamp && stamp->source == source)
        return madeOf(figure, *stamp, true);
    const auto begin = std::chrono::steady_clock::now();
    std::vector<FigureFile> files;
    std::vector<FigureClaim> claims;
    try {
        files = figure.make({source.quick, progress, claims});
    } catch (const Interrupted&) {
        throw;
    } catch (const std::exception& error) {
        return {&figure, "", error.what()};
    }
    if (progress.cancelled()) throw Interrupted();
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
    const FigureStamp stamp = stampOf(source, seconds.count(), files, std::move(claims));
    writeFiles(folder, files, stamp);
    return madeOf(figure, stamp, false);
}

}  // namespace edgewise::figures
