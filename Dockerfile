# The program and the Python module in a small image: docker build -t lamina . && docker run -v "$PWD:/work" lamina mesh ...
FROM debian:bookworm AS build
RUN apt-get update && apt-get install -y --no-install-recommends g++ cmake ninja-build pkg-config dpkg-dev file \
    libtbb-dev libcli11-dev libtomlplusplus-dev libfmt-dev nlohmann-json3-dev libcairo2-dev libcgns-dev zlib1g-dev \
    libeigen3-dev python3-dev python3-venv
RUN python3 -m venv /opt/nanobind && /opt/nanobind/bin/pip install nanobind
COPY . /src
WORKDIR /src
RUN cmake --preset release -B build/package -DCMAKE_INSTALL_PREFIX=/usr -DLAMINA_TESTS=OFF -DLAMINA_PYTHON=ON \
    -DPython_EXECUTABLE=/opt/nanobind/bin/python
RUN cmake --build build/package
RUN cpack --config build/package/CPackConfig.cmake -B /packages

FROM debian:bookworm-slim
COPY --from=build /packages/lamina_*.deb /packages/python3-lamina_*.deb /packages/
RUN apt-get update && apt-get install -y --no-install-recommends /packages/*.deb && rm -rf /var/lib/apt/lists/* /packages
WORKDIR /work
ENTRYPOINT ["lamina"]
