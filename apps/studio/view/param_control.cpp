// SPDX-License-Identifier: Apache-2.0
#include "param_control.h"

#include "section.h"

#include <QLineEdit>
#include <QSignalBlocker>

#include <algorithm>
#include <limits>

namespace asperity::studio {

namespace {

/// "self-affine" -> "Self-affine".
QString entry_of(const std::string& choice) {
    QString text = QString::fromStdString(choice);
    return text.left(1).toUpper() + text.mid(1);
}

template <typename T>
Bindings::Read<T> reader(const Param<StudioSettings>& param) {
    return [get = param.get](const StudioSettings& s) {
        if constexpr (std::is_same_v<T, int>)
            return static_cast<int>(std::get<std::int64_t>(get(s)));
        else
            return std::get<T>(get(s));
    };
}

template <typename T>
Bindings::Write<T> writer(const Param<StudioSettings>& param) {
    return [set = param.set](StudioSettings& s, T value) {
        if constexpr (std::is_same_v<T, int>)
            set(s, std::int64_t{value});
        else
            set(s, value);
    };
}

QString suffix_of(const ParamInfo& info) {
    if (info.unit == "degrees") return "°";
    return info.unit.empty() ? QString() : " " + QString::fromStdString(info.unit);
}

QWidget* real_control(const Param<StudioSettings>& param, const QString& label,
                      Bindings& bindings) {
    constexpr int kDecimals = 4;
    constexpr double kOneDigit = 1e-4, kLongestSlider = 180;
    const Range& range = param.info.range;
    // An open end is not in the range: the box ends one digit before it
    const double low = std::max(range.low + (range.low_open ? kOneDigit : 0), -1e15);
    const double high = std::min(range.high - (range.high_open ? kOneDigit : 0), 1e15);
    if (high - low <= kLongestSlider) {
        auto* field =
            new SliderField(kebab_case(label), low, high, kDecimals, high - low > 2 ? 1 : 0.01);
        field->box().setSuffix(suffix_of(param.info));
        bindings.bind(field, label, reader<double>(param), writer<double>(param));
        return field;
    }
    auto* box = new NumberBox(low, high, kDecimals, 0.1);
    box->setSuffix(suffix_of(param.info));
    bindings.bind(box, label, reader<double>(param), writer<double>(param));
    return box;
}

QWidget* integer_control(const Param<StudioSettings>& param, const QString& label,
                         Bindings& bindings) {
    constexpr double kLeast = std::numeric_limits<int>::min(),
                     kMost = std::numeric_limits<int>::max();
    auto* box = new QSpinBox;
    box->setRange(static_cast<int>(std::max(param.info.range.low, kLeast)),
                  static_cast<int>(std::min(param.info.range.high, kMost)));
    box->setSuffix(suffix_of(param.info));
    bindings.bind(box, label, reader<int>(param), writer<int>(param));
    return box;
}

QWidget* choice_control(const Param<StudioSettings>& param, const QString& label,
                        Bindings& bindings) {
    auto* list = new QComboBox;
    for (const std::string& choice : param.info.choices) list->addItem(entry_of(choice));
    bindings.bind(
        list, label,
        [get = param.get, choices = param.info.choices](const StudioSettings& s) {
            const auto found =
                std::find(choices.begin(), choices.end(), std::get<std::string>(get(s)));
            return static_cast<int>(found - choices.begin());
        },
        [set = param.set, choices = param.info.choices](StudioSettings& s, int index) {
            set(s, choices[static_cast<std::size_t>(index)]);
        });
    return list;
}

QWidget* natural_control(const Param<StudioSettings>& param, const QString& label,
                         Bindings& bindings, Document& document) {
    auto* box = new NaturalBox;
    bindings.follow([box, read = reader<std::uint64_t>(param)](const StudioSettings& s) {
        box->set_value(read(s));
    });
    QObject::connect(
        box, &NaturalBox::changed, &document, [&document, label, set = param.set](quint64 value) {
            document.change(label,
                            [&](StudioSettings& s) { set(s, static_cast<std::uint64_t>(value)); });
        });
    return box;
}

QWidget* text_control(const Param<StudioSettings>& param, const QString& label, Bindings& bindings,
                      Document& document) {
    auto* line = new QLineEdit;
    bindings.follow([line, param](const StudioSettings& s) {
        line->setText(QString::fromStdString(param.text(s)));
    });
    QObject::connect(line, &QLineEdit::editingFinished, &document, [&document, line, label, param] {
        StudioSettings wanted = document.settings();
        try {
            param.apply(wanted, line->text().toStdString());
        } catch (const Error&) {  // what was typed is no value: the old one comes back
            line->setText(QString::fromStdString(param.text(document.settings())));
            return;
        }
        document.change(label, [&](StudioSettings& s) { param.set(s, param.get(wanted)); });
    });
    return line;
}

QWidget* control_of(const Param<StudioSettings>& param, const QString& label, Bindings& bindings,
                    Document& document) {
    // What may be left open has a word for that
    if (!param.info.absent.empty()) return text_control(param, label, bindings, document);
    switch (param.info.type) {
        case ParamType::Flag: {
            auto* box = new QCheckBox;
            bindings.bind(box, label, reader<bool>(param), writer<bool>(param));
            return box;
        }
        case ParamType::Integer:
            return integer_control(param, label, bindings);
        case ParamType::Natural:
            return natural_control(param, label, bindings, document);
        case ParamType::Real:
            return real_control(param, label, bindings);
        case ParamType::Choice:
            return choice_control(param, label, bindings);
        case ParamType::Text:
        case ParamType::List:
        case ParamType::Pair:
            break;
    }
    return text_control(param, label, bindings, document);
}

}  // namespace

NaturalBox::NaturalBox(QWidget* parent) : QAbstractSpinBox(parent) {
    setKeyboardTracking(false);
    setFocusPolicy(Qt::StrongFocus);
    lineEdit()->setText("0");
    connect(this, &QAbstractSpinBox::editingFinished, this, [this] {
        bool whole = false;
        const std::uint64_t typed = lineEdit()->text().toULongLong(&whole);
        take(whole ? typed : value_);
    });
}

void NaturalBox::set_value(std::uint64_t value) {
    value_ = value;
    lineEdit()->setText(QString::number(static_cast<quint64>(value)));
}

void NaturalBox::stepBy(int steps) {
    constexpr std::uint64_t kMost = std::numeric_limits<std::uint64_t>::max();
    const auto distance = static_cast<std::uint64_t>(std::abs(steps));
    if (steps < 0)
        take(value_ - std::min(distance, value_));
    else
        take(value_ + std::min(distance, kMost - value_));
}

QValidator::State NaturalBox::validate(QString& text, int&) const {
    if (text.isEmpty()) return QValidator::Intermediate;
    bool whole = false;
    text.toULongLong(&whole);
    return whole ? QValidator::Acceptable : QValidator::Invalid;
}

void NaturalBox::take(std::uint64_t value) {
    const bool other = value != value_;
    set_value(value);
    if (other) emit changed(value);
}

QWidget* make_control(const Param<StudioSettings>& param, const QString& label, Bindings& bindings,
                      Document& document) {
    QWidget* control = control_of(param, label, bindings, document);
    if (control->objectName().isEmpty()) control->setObjectName(kebab_case(label));
    return control;
}

QString tooltip_of(const Param<StudioSettings>& param) {
    const std::string otherwise =
        param.info.otherwise.empty() ? param.default_text() : param.info.otherwise;
    QString text = QString::fromStdString(help_text(param.info));
    text = text.left(1).toUpper() + text.mid(1);
    return QObject::tr("%1. Without a choice: %2").arg(text, QString::fromStdString(otherwise));
}

}  // namespace asperity::studio
