// Puts the data of a chart into its page.
#include "Chart/ChartPage.h"

#include <cassert>
#include <string_view>

namespace Lantern
{

const char* GetChartFile(std::string_view FileName); // made by EmbedText.cmake

namespace
{

/// JSON has "<" only inside of strings, where it may as well be escaped: neither "</script>" nor "<!--" is left.
std::string MakeScriptSafe(std::string_view Json)
{
	std::string Safe;
	Safe.reserve(Json.size());
	for (const char Character : Json)
	{
		if (Character == '<') { Safe += "\\u003c"; }
		else { Safe += Character; }
	}
	return Safe;
}

std::string FillTemplate(std::string_view Template, const nlohmann::json& Json)
{
	const std::string Data = MakeScriptSafe(Json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
	std::string Page;
	Page.reserve(Template.size() + Data.size() + (size_t{1} << 18));
	for (size_t At = 0; At < Template.size();)
	{
		const size_t Open = Template.find("{{", At);
		const size_t Close = Template.find("}}", Open == std::string_view::npos ? Open : Open + 2);
		if (Close == std::string_view::npos)
		{
			Page += Template.substr(At);
			break;
		}
		Page += Template.substr(At, Open - At);
		const std::string_view Name = Template.substr(Open + 2, Close - Open - 2);
		const char* File = Name == "Data" ? Data.c_str() : GetChartFile(Name);
		assert(File != nullptr && "the template names a file that is not embedded");
		Page += File != nullptr ? File : "";
		At = Close + 2;
	}
	return Page;
}

} // namespace

std::string MakeChartPage(const nlohmann::json& DataWithImages) { return FillTemplate(GetChartFile("Page.html"), DataWithImages); }

std::string MakeGrowthPage(const nlohmann::json& Figures) { return FillTemplate(GetChartFile("Growth.html"), Figures); }

} // namespace Lantern
