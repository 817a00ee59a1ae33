// What a sweep writes of an item.
#include <cmath>

#include <fmt/format.h>

#include "Chart/ChartSweep.h"
#include "LanternCore/Text/Log.h"
#include "LanternCore/Text/Quote.h"
#include "LanternImage/ColorMap.h"
#include "LanternImage/ImageEncode.h"
#include "LanternImage/ImageStatistics.h"
#include "LanternImage/ToneMap.h"

namespace Lantern
{

namespace
{
constexpr uint32_t MaxPictureWidth = 640;

nlohmann::json ToJson(const std::optional<double>& Figure)
{
	return Figure && std::isfinite(*Figure) ? nlohmann::json(*Figure) : nlohmann::json(nullptr);
}

/// Radiance is shown so that the reference's mean comes out as a middle grey; what lies in 0 to 1, as it is.
FImage MakePicture(ESignal Signal, const FImage& Image, const FImage& Reference)
{
	const FImage Small = ShrinkImage(Image, MaxPictureWidth);
	if (!GetSignalInfo(Signal).bRadiance) { return Small; }
	const double Mean = ComputeMeans(MakeColorImage(Reference)).Luminance;
	return ToneMapImage(MakeColorImage(Small), Mean > 0.0 && std::isfinite(Mean) ? static_cast<float>(std::log2(0.2 / Mean)) : 0.0f);
}
} // namespace

FChartPart FChartSweep::MakePart(const FScene& Scene, const FChartItem& Item) const
{
	const FRTCapabilities& Device = Session.GetDevice().GetCapabilities();
	FChartPart Part;
	Part["key"] = MakeChartKey(Scene.Key, Methods, Item);
	Part["order"] = {Scene.Index, Item.bFacts ? 0 : static_cast<size_t>(Item.Path) + 1, Item.Method, Item.Preset};
	Part["device"] = Device.DeviceName;
	Part["driver"] = Device.DriverName;
	Part["is_cpu"] = Device.bIsCpu;
	Part["settings"] = Desc.Settings.ToJson();
	Part["scene"] = {{"name", Scene.Name}, {"width", Desc.Settings.Width}, {"height", Desc.Settings.Height},
	    {"view", DescribeView(Desc.Pictures[Scene.Index])}};
	if (Item.bFacts) { return Part; }
	const FSignalInfo& Signal = GetSignalInfo(Methods.Methods[Item.Method].Signal);
	Part["signal"] = {{"name", Signal.Name}, {"title", Signal.Title}};
	return Part;
}

nlohmann::json FChartSweep::MakePoint(FScene& Scene, const FChartItem& Item, const FMethodFigures& Figures, FChartPart& Part)
{
	const FMethod& Method = Methods.Methods[Item.Method];
	const std::string Key = Part["key"];
	const FImage& Reference = Scene.References.at({Method.Signal, Item.Path}).Home.Mean;
	Part["images"] = {{Key + ".picture", MakeJpegUri(MakePicture(Method.Signal, Figures.Picture, Reference))},
	    {Key + ".heatmap", MakeJpegUri(ShrinkImage(MakeHeatMap(Figures.FlipMap), MaxPictureWidth))}};
	return {{"signal", GetSignalInfo(Method.Signal).Name}, {"method", Method.Title}, {"preset", Method.Presets[Item.Preset].Name},
	    {"path", GetPathName(Item.Path)}, {"gpu_ms", ToJson(Figures.GpuMs)}, {"frame_gpu_ms", ToJson(Figures.FrameGpuMs)},
	    {"rays_per_pixel", Figures.RaysPerPixel}, {"memory", Figures.MemoryBytes}, {"memory_peak", Figures.PeakBytes},
	    {"relmse", ToJson(Figures.RelMse)}, {"flip", ToJson(Figures.Flip)}, {"sigma", ToJson(Figures.Sigma)},
	    {"t90_frames", ToJson(Figures.T90Frames)}, {"t90_reached", Figures.bT90Reached}, {"ghost", ToJson(Figures.Ghost)},
	    {"leak", ToJson(Figures.Leak)}, {"frames", Figures.Frames}, {"reference_spp", Scene.Samples.at(Method.Signal)},
	    {"picture", Key + ".picture"}, {"heatmap", Key + ".heatmap"}};
}

int FChartSweep::Keep(const FScene&, const FChartItem&, FChartPart Part)
{
	if (FRTStatus S = WritePart(Desc.PartsFolder, Part); !S) { return ReportStatus(S, "-o"), ExitBadInput; }
	// As another run would find it.
	FChartPart Written = ReadPart(Desc.PartsFolder, Part["key"].get<std::string>());
	if (Written.is_null())
	{
		LogError("{}: cannot be read back", EscapePath(GetPartFile(Desc.PartsFolder, Part["key"].get<std::string>())));
		return ExitBadInput;
	}
	Parts.push_back(std::move(Written));
	return ExitDone;
}

int FChartSweep::Skip(const FScene& Scene, const FChartItem& Item, const std::string& Reason)
{
	const FMethod& Method = Methods.Methods[Item.Method];
	FChartPart Part = MakePart(Scene, Item);
	Part["skipped"] = {{"signal", GetSignalInfo(Method.Signal).Name}, {"method", Method.Title},
	    {"preset", Method.Presets[Item.Preset].Name}, {"path", GetPathName(Item.Path)}, {"reason", Reason}};
	return Keep(Scene, Item, std::move(Part));
}

} // namespace Lantern
