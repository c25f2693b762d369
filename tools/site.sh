#!/usr/bin/env bash
# Builds the web site of docs/ into out/site with MkDocs and mkdocs.yml. Fails at broken links. Needs Debian's packages mkdocs
# and npm, which fetches Mermaid at the first run. The site itself loads nothing from elsewhere.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

readonly MERMAID=11.17.2
readonly MERMAID_SHA256=581ed7d74bd9048d0e3a91363927d72ef22942d7722546b27f7cc29e35390eb8
readonly NPM_FOLDER=out/npm

fail() {
    echo "site.sh: $*" >&2
    exit 1
}

need() {
    command -v "$1" >/dev/null || fail "$1 is missing; on Debian: apt-get install --no-install-recommends $1"
}

is_mermaid() {
    echo "$MERMAID_SHA256  $NPM_FOLDER/mermaid.min.js" | sha256sum --check --status 2>/dev/null
}

# Only one file of the package is needed, and none of its dependencies.
fetch_mermaid() {
    is_mermaid && return
    need npm
    mkdir -p "$NPM_FOLDER"
    npm pack --silent --pack-destination "$NPM_FOLDER" "mermaid@$MERMAID" >/dev/null || fail "npm cannot fetch mermaid $MERMAID"
    tar -xzf "$NPM_FOLDER/mermaid-$MERMAID.tgz" -C "$NPM_FOLDER" --strip-components=2 package/dist/mermaid.min.js
    rm "$NPM_FOLDER/mermaid-$MERMAID.tgz"
    is_mermaid || fail "$NPM_FOLDER/mermaid.min.js has another checksum than expected"
}

need mkdocs
fetch_mermaid
mkdocs build --strict --clean
mkdir -p out/site/js
cp "$NPM_FOLDER/mermaid.min.js" tools/site/diagrams.js out/site/js/
echo "$PWD/out/site/index.html"
