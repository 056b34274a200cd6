// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/core/run.h>
#include <asperity/gonio/measurement.h>
#include <asperity/surface/heightfield.h>

#include <QObject>
#include <QString>

#include <map>
#include <memory>

namespace asperity::studio {

/// The layers of a run as far as they are filled: the thesis' sky-map textures. Cheap to copy,
/// what it points to never changes.
struct Layers {
    /// Everything but the layers; null: nothing drawn.
    std::shared_ptr<const Measurement> head;
    std::map<int, std::shared_ptr<const Layer>> by_number;  ///< Layer::number
    bool complete = false;

    const Layer* layer(int number) const {
        const auto found = by_number.find(number);
        return found == by_number.end() ? nullptr : found->second.get();
    }
};

/// Draws to textures: runs measure() in a thread of its own and shows the layers as they fill.
///
/// Lives in the main thread; so do its signals.
class Drawing : public QObject {
    Q_OBJECT

  public:
    enum class State { Idle, Drawing, Paused };

    explicit Drawing(QObject* parent = nullptr);
    ~Drawing() override;  ///< stops; returns within 100 ms

    /// Draw To Textures. Clears the layers first. Throws Error(Usage) for settings out of range.
    void start(std::shared_ptr<const Heightfield> surface, const Experiment& experiment);
    void pause();
    void resume();
    void stop();   ///< Stop Drawing: ends and clears, as in the thesis
    void clear();  ///< Clear Textures; also ends a run
    /// Layers from a result file. Throws what io::load_measurement throws.
    void open(const QString& path);

    State state() const;
    const Layers& layers() const;
    /// The whole result, once complete; null before.
    std::shared_ptr<const Measurement> result() const;
    Progress progress() const;
    QString checksum() const;  ///< of result(), as the CLI prints it; empty before

  signals:
    void state_changed();
    void layers_changed(int number);  ///< of the layer that grew or was completed; 0: all (cleared)
    void progressed();                ///< about ten times a second
    void completed();
    void failed(const QString& sentence);

  private:
    class Work;
    std::unique_ptr<Work> work_;
};

}  // namespace asperity::studio
