// The plan of a chart: which parts are to be measured.
#include "LanternMeasure/Chart/ChartPlan.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <tuple>

#include <fmt/format.h>

#include "LanternCore/Text/Quote.h"
#include "LanternHost/SceneHash.h"

namespace Lantern
{

namespace
{
template <class T>
bool Contains(const std::vector<T>& List, const T& Value)
{
	return List.empty() || std::find(List.begin(), List.end(), Value) != List.end();
}

void AddSettings(FContentHasher& Hasher, const std::vector<FMethodSetting>& Settings)
{
	Hasher.Add(uint64_t(Settings.size()));
	for (const FMethodSetting& Setting : Settings)
	{
		Hasher.AddText(Setting.Name);
		Hasher.AddText(Setting.Value);
	}
}
} // namespace

nlohmann::json FChartSettings::ToJson() const
{
	return {{"size", fmt::format("{}x{}", Width, Height)}, {"reference_spp", ReferenceSamples}, {"frames", Frames}, {"warm_up", WarmUp},
	    {"seed", Seed}, {"variables", Variables}};
}

std::string DescribeVariables()
{
	std::string Text;
	for (const FRTConsoleVariable* Variable : FConsoleVariables::Get().GetAll())
	{
		if (Variable->GetSetBy() == ERTSetBy::Code || Variable->GetValue() == Variable->GetDefault()) { continue; }
		Text += (Text.empty() ? "" : " ") + Variable->GetName() + '=' + EscapeText(FConsoleVariables::ToString(Variable->GetValue()));
	}
	return Text;
}

std::vector<FChartItem> ListChartItems(const FMethods& Methods, const FChartSelection& Selection)
{
	std::vector<FChartItem> Out;
	Out.push_back({.bFacts = true});
	for (size_t P = 0; P < static_cast<size_t>(EMeasurePath::Count); ++P)
	{
		const auto Path = static_cast<EMeasurePath>(P);
		if (!Contains(Selection.Paths, Path)) { continue; }
		for (size_t M = 0; M < Methods.Methods.size(); ++M)
		{
			const FMethod& Method = Methods.Methods[M];
			if (!Contains(Selection.Signals, Method.Signal) || !Contains(Selection.Methods, Method.Name)) { continue; }
			for (size_t Preset = 0; Preset < Method.Presets.size(); ++Preset) { Out.push_back({false, Path, M, Preset}); }
		}
	}
	return Out;
}

std::optional<FShard> ParseShard(std::string_view Text)
{
	FShard Out;
	const size_t Slash = Text.find('/');
	if (Slash == std::string_view::npos) { return std::nullopt; }
	const auto Parse = [](std::string_view Part, uint32_t& Number) {
		const auto [End, Error] = std::from_chars(Part.data(), Part.data() + Part.size(), Number);
		return Error == std::errc() && End == Part.data() + Part.size() && Number > 0;
	};
	if (!Parse(Text.substr(0, Slash), Out.Number) || !Parse(Text.substr(Slash + 1), Out.Count) || Out.Number > Out.Count)
	{
		return std::nullopt;
	}
	return Out;
}

void SortByPrice(std::vector<FChartItem>& Items)
{
	// Motion that is slow tells least that still and fast do not.
	constexpr std::array<int, static_cast<size_t>(EMeasurePath::Count)> Ranks = {0, 3, 1, 2};
	const auto Key = [&](const FChartItem& Item) {
		return std::tuple(!Item.bFacts, Item.Preset, Ranks[static_cast<size_t>(Item.Path)], Item.Index);
	};
	std::sort(Items.begin(), Items.end(), [&](const FChartItem& A, const FChartItem& B) { return Key(A) < Key(B); });
}

uint32_t ChooseSamples(double SecondsPerSample, double Budget, uint32_t Most)
{
	uint32_t Samples = std::min(4u, Most);
	while (Samples * 2 <= Most && SecondsPerSample * Samples * 2 <= Budget) { Samples *= 2; }
	// A number that is no power of two was asked for, and fits.
	return Samples * 2 > Most && SecondsPerSample * Most <= Budget ? Most : Samples;
}

std::string MakeChartKey(const FChartKeyParts& Parts, const FMethods& Methods, const FChartItem& Item)
{
	FContentHasher Hasher;
	for (const std::string* Text : {&Parts.Program, &Parts.Device, &Parts.Driver, &Parts.Scene}) { Hasher.AddText(*Text); }
	Hasher.AddText(Parts.Settings.ToJson().dump());
	AddSettings(Hasher, Methods.Defaults);
	Hasher.Add(Item.bFacts);
	// Which method facts are measured with is the registry's choice: all of it counts for them.
	for (size_t M = 0; M < Methods.Methods.size(); ++M)
	{
		if (!Item.bFacts && M != Item.Method) { continue; }
		const FMethod& Method = Methods.Methods[M];
		Hasher.AddText(Method.Name);
		Hasher.AddText(Method.Title);
		Hasher.Add(Method.Signal);
		Hasher.Add(Method.Needs);
		AddSettings(Hasher, Method.Settings);
		for (size_t P = 0; P < Method.Presets.size(); ++P)
		{
			if (!Item.bFacts && P != Item.Preset) { continue; }
			Hasher.AddText(Method.Presets[P].Name);
			AddSettings(Hasher, Method.Presets[P].Settings);
		}
	}
	if (!Item.bFacts) { Hasher.AddText(GetPathName(Item.Path)); }
	return Hasher.Finish().ToHex();
}

} // namespace Lantern
