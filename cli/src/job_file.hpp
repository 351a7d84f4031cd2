// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Job files of the subcommands: TOML tables owned by the rooms, put together here.
#pragma once

#include <cusp/base/toml_schema.hpp>
#include <cusp/post/writer/post_options.hpp>

namespace cusp::cli {

struct PostJob {
    post::PostOptions post;
};

[[nodiscard]] inline const base::Section<PostJob>& postJobSection() {
    static const auto section =
        base::Section<PostJob>("A posting job.").table("post", &PostJob::post, post::postSection());
    return section;
}

}  // namespace cusp::cli
