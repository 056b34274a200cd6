// SPDX-License-Identifier: Apache-2.0
#include "param_control.h"

#include "colour_field.h"
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

QWidget* real_control(const Param<StudioSettings>& param, const QString& label, const QString& name,
                      Bindings& bindings) {
    constexpr int kDecimals = 4;
    constexpr double kOneDigit = 1e-4, kLongestSlider = 180, kMostRatio = 1000;
    const Range& range = param.info.range;
    // An open end is not in the range: the box ends one digit before it
    const double low = std::max(range.low + (range.low_open ? kOneDigit : 0), -1e15);
    const double high = std::min(range.high - (range.high_open ? kOneDigit : 0), 1e15);
    // No slider is fine at one end of a range over orders of magnitude and quick to the other
    const bool magnitudes = range.low > 0 && range.high > kMostRatio * range.low;
    if (high - low <= kLongestSlider && !magnitudes) {
        auto* field = new SliderField(name, low, high, kDecimals, high - low > 2 ? 1 : 0.01);
        field->box().setSuffix(suffix_of(param.info));
        bindings.bind(field, label, reader<double>(param), writer<double>(param));
        return field;
    }
    constexpr int kDecimalsOfTiny = 9;
    auto* box =
        new NumberBox(low, high, low > 0 && low < kOneDigit ? kDecimalsOfTiny : kDecimals, 0.1);
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

/// The word for a choice left open is the first of the list.
QWidget* choice_control(const Param<StudioSettings>& param, const QString& label,
                        Bindings& bindings) {
    auto* list = new QComboBox;
    std::vector<ParamValue> values(param.info.choices.begin(), param.info.choices.end());
    if (!param.info.absent.empty()) values.emplace(values.begin());
    for (const ParamValue& value : values)
        list->addItem(entry_of(std::holds_alternative<std::monostate>(value)
                                   ? param.info.absent
                                   : std::get<std::string>(value)));
    bindings.bind(
        list, label,
        [get = param.get, values](const StudioSettings& s) {
            return static_cast<int>(std::find(values.begin(), values.end(), get(s)) -
                                    values.begin());
        },
        [set = param.set, values](StudioSettings& s, int index) {
            set(s, values[static_cast<std::size_t>(index)]);
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

/// A list of shares that cannot be left open is one for each of red, green and blue.
bool is_colour(const ParamInfo& info) {
    return info.type == ParamType::List && info.range.low == 0 && info.range.high == 1 &&
           info.most >= 3;
}

QWidget* colour_control(const Param<StudioSettings>& param, const QString& label,
                        const QString& name, Bindings& bindings, Document& document) {
    auto* field = new ColourField(name);
    bindings.follow([field, get = param.get](const StudioSettings& s) {
        const auto list = std::get<std::vector<double>>(get(s));
        const auto entry = [&](std::size_t k) { return list[list.size() < 3 ? 0 : k]; };
        if (!list.empty()) field->set_value({entry(0), entry(1), entry(2)});
    });
    QObject::connect(
        field, &ColourField::changed, &document, [&document, label, set = param.set](Rgb c) {
            document.change(label, [&](StudioSettings& s) { set(s, std::vector{c.r, c.g, c.b}); });
        });
    return field;
}

QWidget* control_of(const Param<StudioSettings>& param, const QString& label, const QString& name,
                    Bindings& bindings, Document& document) {
    if (param.info.type == ParamType::Choice) return choice_control(param, label, bindings);
    // What may be left open has a word for that
    if (!param.info.absent.empty()) return text_control(param, label, bindings, document);
    if (is_colour(param.info)) return colour_control(param, label, name, bindings, document);
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
            return real_control(param, label, name, bindings);
        case ParamType::Choice:
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

QWidget* make_control(const Param<StudioSettings>& param, const QString& step, Bindings& bindings,
                      Document& document, const QString& name) {
    const QString own = name.isEmpty() ? kebab_case(step) : name;
    QWidget* control = control_of(param, step, own, bindings, document);
    if (control->objectName().isEmpty()) control->setObjectName(own);
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
