// lantern compare: metrics of two images, as a table, JSON and heat map.
#include "Commands/CompareCommand.h"

#include <cstdio>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "LanternCore/Text/Log.h"
#include "LanternCore/Text/Quote.h"
#include "LanternImage/AtomicFile.h"
#include "LanternImage/ColorMap.h"
#include "LanternImage/ImageIO.h"
#include "LanternImage/Metrics.h"

namespace Lantern
{

namespace
{

constexpr int ExitDone = 0;
constexpr int ExitBadInput = 4;

std::string MakeJson(const FImage& B, const FImageMetrics& Metrics)
{
	nlohmann::ordered_json Json;
	Json["width"] = B.Width;
	Json["height"] = B.Height;
	Json["mse"] = Metrics.Mse;
	Json["rmse"] = Metrics.Rmse;
	Json["relmse"] = Metrics.RelMse;
	Json["psnr"] = Metrics.Psnr;
	Json["flip"] = Metrics.Flip;
	Json["flip_weighted_median"] = Metrics.FlipWeightedMedian;
	if (B.Space == EImageSpace::Linear)
	{
		Json["flip_exposures"] = {{"start", Metrics.FlipResult.StartExposure}, {"stop", Metrics.FlipResult.StopExposure},
		    {"count", Metrics.FlipResult.ExposureCount}};
	}
	Json["mean_ratio"] = Metrics.MeanRatio;
	Json["block16_median"] = Metrics.Block16Median;
	Json["block16_p95"] = Metrics.Block16P95;
	Json["nonfinite"] = Metrics.NonFinite;
	return Json.dump(2) + "\n";
}

void PrintTable(const FCompareOptions& Options, const FImage& B, const FImageMetrics& Metrics)
{
	const bool bRadiance = B.Space == EImageSpace::Linear;
	fmt::print("A               {}\n", EscapeText(Options.A));
	fmt::print("B (reference)   {}\n", EscapeText(Options.B));
	fmt::print("size            {} x {}, {}\n", B.Width, B.Height, bRadiance ? "radiance" : "display values");
	fmt::print("mse             {:.6g}\n", Metrics.Mse);
	fmt::print("rmse            {:.6g}\n", Metrics.Rmse);
	fmt::print("relmse          {:.6g}\n", Metrics.RelMse);
	fmt::print("psnr            {:.3f} dB\n", Metrics.Psnr);
	fmt::print("flip            {:.6f}  (weighted median {:.6f})\n", Metrics.Flip, Metrics.FlipWeightedMedian);
	if (bRadiance)
	{
		fmt::print("  exposures     {} from {:+.4f} to {:+.4f} EV\n", Metrics.FlipResult.ExposureCount, Metrics.FlipResult.StartExposure,
		    Metrics.FlipResult.StopExposure);
	}
	fmt::print("mean_ratio      {:.6f} {:.6f} {:.6f}\n", Metrics.MeanRatio[0], Metrics.MeanRatio[1], Metrics.MeanRatio[2]);
	fmt::print("block16_median  {:.6f}\n", Metrics.Block16Median);
	fmt::print("block16_p95     {:.6f}\n", Metrics.Block16P95);
	fmt::print("nonfinite       {} {}\n", Metrics.NonFinite[0], Metrics.NonFinite[1]);
	std::fflush(stdout);
}

/// Before the images are compared, which may take seconds.
FRTStatus CheckOutputs(const FCompareOptions& Options)
{
	FRTStatus Status;
	if (!Options.Heatmap.empty()) { Status = CheckImageOutput(Options.Heatmap); }
	if (Status && !Options.Json.empty()) { Status = CheckOutputPath(Options.Json); }
	return Status;
}

FRTStatus Compare(const FCompareOptions& Options)
{
	if (FRTStatus Status = CheckOutputs(Options); !Status) { return Status; }
	FImage A;
	FImage B;
	if (FRTStatus Status = LoadImageFile(Options.A, A); !Status) { return Status; }
	if (FRTStatus Status = LoadImageFile(Options.B, B); !Status) { return Status; }
	FImageMetrics Metrics;
	if (FRTStatus Status = CompareImages(A, B, Metrics); !Status) { return MakeFileError(Status.Code, Options.A, Status.Message); }
	if (!Options.Heatmap.empty())
	{
		if (FRTStatus Status = SaveImageFile(Options.Heatmap, MakeHeatMap(Metrics.FlipResult.Map)); !Status) { return Status; }
	}
	if (!Options.Json.empty())
	{
		if (FRTStatus Status = WriteFileAtomically(Options.Json, MakeJson(B, Metrics)); !Status) { return Status; }
	}
	PrintTable(Options, B, Metrics);
	return FRTStatus::Success();
}

} // namespace

int RunCompare(const FCompareOptions& Options)
{
	const FRTStatus Status = Compare(Options);
	if (!Status)
	{
		LogError("{}", static_cast<const char*>(Status.Message));
		return ExitBadInput;
	}
	return ExitDone;
}

} // namespace Lantern
