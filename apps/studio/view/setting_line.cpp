// SPDX-License-Identifier: Apache-2.0
#include "setting_line.h"

#include "progress_row.h"
#include "theme.h"

#include <QSignalBlocker>

#include <utility>

namespace asperity::studio {

void mark_field(QWidget& field, bool wrong) {
    QPalette colours;
    if (wrong) {
        constexpr double kTint = 0.35;
        const QColor base = field.parentWidget()
                                ? field.parentWidget()->palette().color(QPalette::Base)
                                : field.palette().color(QPalette::Base);
        colours.setColor(QPalette::Base, mix(base, trouble_colour(), kTint));
        colours.setColor(QPalette::Button, mix(base, trouble_colour(), kTint));
    }
    field.setPalette(colours);
}

SettingLine::SettingLine(const Param<StudioSettings>& param, const QString& step,
                         Document& document, Bindings& bindings, Translate to_row,
                         Translate from_row)
    : param_(param),
      step_(step),
      document_(document),
      to_row_(std::move(to_row)),
      from_row_(std::move(from_row)) {
    setPlaceholderText(QString::fromStdString(param.info.absent));
    bindings.follow([this](const StudioSettings&) { show_setting(); });
    connect(this, &QLineEdit::editingFinished, this, &SettingLine::take);
}

void SettingLine::show_setting() {
    const StudioSettings& settings = document_.settings();
    std::string shown = param_.text(settings);
    if (shown == param_.info.absent) shown.clear();
    if (from_row_ && !shown.empty()) shown = from_row_(shown);
    const QString line = QString::fromStdString(shown);
    const bool typing = hasFocus() && isModified();
    if (line == shown_ && (typing || !mistake_.isEmpty())) return;  // no change of this setting
    shown_ = line;
    if (line != text() && !typing) {
        setText(line);
        setCursorPosition(0);
        mistake_.clear();
        show_mark();
    }
}

void SettingLine::setToolTipOfSetting(const QString& tooltip) {
    tooltip_ = tooltip;
    setToolTip(tooltip);
}

void SettingLine::mark(const QString& why) {
    trouble_ = why;
    show_mark();
}

void SettingLine::show_mark() {
    const QString& why = mistake_.isEmpty() ? trouble_ : mistake_;
    mark_field(*this, !why.isEmpty());
    setToolTip(why.isEmpty() ? tooltip_ : why);
}

void SettingLine::take() {
    setModified(false);
    StudioSettings wanted = document_.settings();
    try {
        std::string typed = text().trimmed().toStdString();
        if (typed.empty())
            typed = param_.info.absent.empty() ? param_.default_text() : param_.info.absent;
        else if (to_row_)
            typed = to_row_(typed);
        param_.apply(wanted, typed);
    } catch (const Error& error) {
        mistake_ = QString::fromStdString(error.message());
        show_mark();
        emit refused(step_ + ": " + mistake_);
        return;
    }
    mistake_.clear();
    show_mark();
    emit refused({});
    const ParamValue value = param_.get(wanted);
    document_.change(step_, [&](StudioSettings& s) { param_.set(s, value); });
    show_setting();
}

}  // namespace asperity::studio
