// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bindings.h"

#include <asperity/params/param.h>

#include <QLineEdit>

#include <functional>
#include <string>

namespace asperity::studio {

/// A setting as text. Nothing typed stands for the row's word for no value. What is no value stays
/// to be mended: the line is marked, its tooltip says why, and `refused` is emitted.
class SettingLine : public QLineEdit {
    Q_OBJECT

  public:
    using Translate = std::function<std::string(const std::string&)>;

    /// `step` is the name in the Edit menu. `to_row` makes of what a user types what the row reads,
    /// `from_row` the other way; empty: nothing to translate. They may throw Error.
    SettingLine(const Param<StudioSettings>& param, const QString& step, Document& document,
                Bindings& bindings, Translate to_row = {}, Translate from_row = {});

    /// Shows the setting again, in case from_row depends on more than it.
    void show_setting();
    /// Marks the line for what became of its value, and says why; an empty sentence takes that mark
    /// off, but not the one for a text that is no value.
    void mark(const QString& why);
    void setToolTipOfSetting(const QString& tooltip);

  signals:
    void refused(const QString& sentence);  ///< empty: no longer

  private:
    void take();
    void show_mark();

    Param<StudioSettings> param_;
    QString step_, tooltip_;
    QString shown_;              ///< of the setting, last
    QString mistake_, trouble_;  ///< of the text, of the value
    Document& document_;
    Translate to_row_, from_row_;
};

/// Tints a field that holds something wrong; an empty sentence takes the tint off.
void mark_field(QWidget& field, bool wrong);

}  // namespace asperity::studio
