// Prints rows, writes JSON and strips, and reads the list of known shortfalls.
#include "Stability/StabilityReport.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>

#include <fmt/format.h>

#include "LanternImage/AtomicFile.h"
#include "LanternImage/ImageIO.h"
#include "LanternImage/ToneMap.h"

namespace Lantern
{

namespace
{
std::string Trim(const std::string& Text)
{
	const size_t First = Text.find_first_not_of(" \t\r"), Last = Text.find_last_not_of(" \t\r");
	return First == std::string::npos ? std::string() : Text.substr(First, Last - First + 1);
}

std::string FormatFigure(const std::optional<double>& Value)
{
	if (!Value) { return "-"; }
	return std::isfinite(*Value) ? fmt::format("{:.4g}", *Value) : "nan";
}

/// JSON knows no NaN.
nlohmann::json ToJson(const std::optional<double>& Value)
{
	return Value && std::isfinite(*Value) ? nlohmann::json(*Value) : nlohmann::json(nullptr);
}
nlohmann::json ToJson(const std::optional<bool>& Value) { return Value ? nlohmann::json(*Value) : nlohmann::json(nullptr); }
nlohmann::json ToJson(const std::string& Text) { return Text.empty() ? nlohmann::json(nullptr) : nlohmann::json(Text); }
} // namespace

FRTStatus FKnownShortfalls::Load(const std::string& Path)
{
	std::ifstream File(Path);
	if (!File) { return MakeFileError(ERTResult::IoError, Path, "cannot be read"); }
	std::string Line;
	for (int Number = 1; std::getline(File, Line); ++Number)
	{
		Line = Trim(Line.substr(0, Line.find('#')));
		if (Line.empty()) { continue; }
		std::vector<std::string> Fields;
		for (size_t Begin = 0; Begin <= Line.size();)
		{
			const size_t End = std::min(Line.find('|', Begin), Line.size());
			Fields.push_back(Trim(Line.substr(Begin, End - Begin)));
			Begin = End + 1;
		}
		const int Case = std::atoi(Fields[0].c_str());
		FBand Band;
		int Read = 0;
		const bool bForm = Fields.size() == 5 && Case > 0 && !Fields[4].empty() &&
		                   std::sscanf(Fields[3].c_str(), "%lf +- %lf%n", &Band.Figure, &Band.Width, &Read) == 2 &&
		                   Fields[3].size() == static_cast<size_t>(Read) && Band.Width > 0.0;
		if (!bForm)
		{
			return MakeFileError(ERTResult::InvalidArgument, Path + ":" + std::to_string(Number),
			    "is not of the form case | method | part | figure +- band | reason");
		}
		Known[{Case, Fields[1], Fields[2]}] = Band;
	}
	return FRTStatus::Success();
}

bool FKnownShortfalls::Has(const FStabilityRow& Row) const { return Known.count({Row.Number, Row.Method, Row.Part}) > 0; }

std::vector<std::string> FKnownShortfalls::Check(const std::vector<FStabilityRow>& Rows) const
{
	std::vector<std::string> Bad;
	for (const FStabilityRow& Row : Rows)
	{
		const auto Found = Known.find({Row.Number, Row.Method, Row.Part});
		const bool bKnown = Found != Known.end();
		const std::string Name = fmt::format("{} {} | {} | {}", Row.Number, Row.Name, Row.Method, Row.Part);
		const std::string What = Row.bBroken ? Row.Status : Row.Holds && !*Row.Holds ? "does not hold" : "the planted fault goes unnoticed";
		if (Row.IsBad() && !bKnown) { Bad.push_back(Name + ": " + What); }
		if (bKnown && !Row.IsBad()) { Bad.push_back(Name + ": a known shortfall holds now; take it off the list"); }
		else if (bKnown && Row.Figure && !(std::abs(*Row.Figure - Found->second.Figure) <= Found->second.Width))
		{
			Bad.push_back(fmt::format(
			    "{}: {:.4g} is no longer the known {:.4g} +- {:.4g}", Name, *Row.Figure, Found->second.Figure, Found->second.Width));
		}
	}
	return Bad;
}

void PrintStabilityHeader()
{
	fmt::print("{:>2} {:<20} {:<42} {:<33} {:>10} {:>10} {:>9} {:<7} {:>10} {}\n", "#", "case", "method", "figure", "median", "worst",
	    "limit", "holds", "fault", "fails");
}

void PrintStabilityRow(const FStabilityRow& Row)
{
	if (!Row.Status.empty())
	{
		fmt::print("{:>2} {:<20} {:<42} {}\n", Row.Number, Row.Name, Row.Method, Row.Status);
		return;
	}
	const std::string Limit = Row.Limit ? (Row.bFloor ? ">=" : "<=") + FormatFigure(Row.Limit) : "-";
	const char* const Holds = !Row.Holds ? "-" : *Row.Holds ? "yes" : Row.bKnown ? "known" : "NO";
	const char* const Fails = !Row.FaultFails ? "-" : *Row.FaultFails ? "yes" : "NO";
	fmt::print("{:>2} {:<20} {:<42} {:<33} {:>10} {:>10} {:>9} {:<7} {:>10} {}\n", Row.Number, Row.Name, Row.Method, Row.Part,
	    FormatFigure(Row.Figure), FormatFigure(Row.Worst), Limit, Holds, FormatFigure(Row.FaultFigure), Fails);
	std::fflush(stdout);
}

nlohmann::json MakeStabilityJson(const std::vector<FStabilityRow>& Rows)
{
	nlohmann::json Cases = nlohmann::json::array();
	for (const FStabilityRow& Row : Rows)
	{
		Cases.push_back({{"number", Row.Number}, {"name", Row.Name}, {"part", ToJson(Row.Part)}, {"method", ToJson(Row.Method)},
		    {"preset", ToJson(Row.Preset)}, {"signal", ToJson(Row.Signal)}, {"status", ToJson(Row.Status)}, {"figure", ToJson(Row.Figure)},
		    {"worst", ToJson(Row.Worst)}, {"limit", ToJson(Row.Limit)}, {"at_least", Row.bFloor}, {"holds", ToJson(Row.Holds)},
		    {"known", Row.bKnown}, {"fault", ToJson(Row.Fault)}, {"fault_figure", ToJson(Row.FaultFigure)},
		    {"fault_fails", ToJson(Row.FaultFails)}, {"seeds", Row.Seeds}});
	}
	return Cases;
}

namespace
{
void Paste(FImage& Into, const FImage& Picture, uint32_t X0, uint32_t Y0, uint32_t Zoom)
{
	for (uint32_t Y = 0; Y < Picture.Height * Zoom; ++Y)
	{
		for (uint32_t X = 0; X < Picture.Width * Zoom; ++X)
		{
			for (uint32_t C = 0; C < 3; ++C) { Into.At(X0 + X, Y0 + Y, C) = Picture.At(X / Zoom, Y / Zoom, C); }
		}
	}
}

FImage MakeDisplay(const FImage& Image, const FSignalInfo& Signal, float Exposure)
{
	FImage Color = MakeColorImage(Image);
	for (float& Value : Color.Pixels)
	{
		if (!std::isfinite(Value)) { Value = 0.0f; }
	}
	return Signal.bRadiance ? ToneMapImage(Color, Exposure) : ConvertImage(Color, EImageSpace::Display);
}
} // namespace

FRTStatus SaveStrip(const std::string& Path, const std::vector<std::pair<FImage, FImage>>& Strip, const FSignalInfo& Signal, float Exposure)
{
	constexpr uint32_t Gap = 2, Zoom = 2;
	uint32_t Width = 0, Height = 0;
	bool bReferences = false;
	for (const auto& [Frame, Reference] : Strip)
	{
		Width += Frame.Width * Zoom + Gap;
		Height = std::max(Height, Frame.Height * Zoom + Gap);
		bReferences |= !Reference.IsEmpty();
	}
	FImage Sheet(Width, Height * (bReferences ? 2 : 1), 3, EImageSpace::Display);
	std::fill(Sheet.Pixels.begin(), Sheet.Pixels.end(), 0.25f);
	uint32_t X = 0;
	for (const auto& [Frame, Reference] : Strip)
	{
		Paste(Sheet, MakeDisplay(Frame, Signal, Exposure), X, 0, Zoom);
		if (!Reference.IsEmpty()) { Paste(Sheet, MakeDisplay(Reference, Signal, Exposure), X, Height, Zoom); }
		X += Frame.Width * Zoom + Gap;
	}
	return SaveImageFile(Path, Sheet);
}

} // namespace Lantern
