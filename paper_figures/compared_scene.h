// A scene's picture by several methods, each a worker process as compare has them.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "pipeline/compare/schedule.h"

namespace edgewise::figures {

/// What every method makes.
struct ComparedPicture {
    std::string scene;  ///< a name or a file
    int width = 0, height = 0;
    std::string filter = "box";
    double radius = 0.5;
    std::string device = "cpu";   ///< of methods that name none
    std::size_t most_meshes = 4;  ///< of a reference that is made of meshes
};

/// Of the runs inside: their stages have the name of what is measured.
class Labelled : public Progress {
  public:
    Labelled(Progress& outer, std::string label) : outer_(outer), label_(std::move(label)) {}
    void stage(std::string_view, std::size_t total) override { outer_.stage(label_, total); }
    void advance(std::size_t done) override { outer_.advance(done); }
    bool cancelled() override { return outer_.cancelled(); }

  private:
    Progress& outer_;
    std::string label_;
};

/// Of compare-worker, with memory that holds the image.
std::vector<std::string> workerArguments(const ComparedPicture& picture, const std::string& method);

/// Those of the methods that this build has; why it has not the others, as notes, each once.
std::vector<std::string> knownOf(const std::vector<std::string>& methods, std::vector<std::string>& notes);

/// A row a method, by turns, judged against the reference, which is not timed, and by kinds of edges where
/// those are wished for; a reference for an SDF scene by a triangle method is made of meshes
/// (mesh_reference.h). Rows that failed say why. Throws Interrupted, InputError for no scene or method,
/// WorkerFailure where the reference cannot be made.
compare::Comparison compareOn(const ComparedPicture& picture, const std::string& reference,
                              const std::vector<std::string>& methods,
                              const compare::ScheduleOptions& schedule, Progress& progress,
                              const compare::ReferenceWishes& wishes = {});

/// The same without a reference: times alone.
std::vector<compare::Row> timesOn(const ComparedPicture& picture, const std::vector<std::string>& methods,
                                  compare::ScheduleOptions schedule, Progress& progress);

}  // namespace edgewise::figures
