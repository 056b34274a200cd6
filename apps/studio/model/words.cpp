// SPDX-License-Identifier: Apache-2.0
#include "words.h"

#include "settings_keys.h"

#include <QRegularExpression>

namespace asperity::studio {

namespace {

QString label_of(const QString& name) {
    const auto* row = asperity::find(all_params(), name.toStdString());
    return row == nullptr ? QString() : QString::fromStdString(label(row->info));
}

}  // namespace

std::string setting_complained_of(const QString& sentence) {
    const QString name = sentence.section(": ", 0, 0);
    return sentence.contains(": ") && !label_of(name).isEmpty() ? name.toStdString()
                                                                : std::string();
}

QString in_words_of_forms(const QString& sentence) {
    QString text = sentence;
    if (const std::string name = setting_complained_of(text); !name.empty())
        text.replace(0, static_cast<qsizetype>(name.size()),
                     label_of(QString::fromStdString(name)));
    static const QRegularExpression option("--([a-z][a-z-]*)");
    for (qsizetype from = 0;;) {
        const QRegularExpressionMatch found = option.match(text, from);
        if (!found.hasMatch()) return text;
        const QString label = label_of(found.captured(1));
        const QString instead = label.isEmpty() ? found.captured(0) : label;
        text.replace(found.capturedStart(), found.capturedLength(), instead);
        from = found.capturedStart() + instead.size();
    }
}

}  // namespace asperity::studio
